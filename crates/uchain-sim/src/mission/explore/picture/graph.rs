//! The map with nodes and roadmap.

use glam::Vec2;
use kuva::render::render::Scene;

use super::Sheet;
use crate::draw::{
    colour::{self, GREY, INK},
    ground::{self, on_page},
    name::legend,
    panel::{Panel, dot, rule, unclip},
};

impl Sheet<'_> {
    pub(crate) fn draw_graph(&self, scene: &mut Scene, panel: &Panel) {
        panel.clip(scene);
        ground::paint(scene, panel, &self.site.map);
        let at = |believed_m: [f32; 2]| on_page(panel, &self.site.map, Vec2::from(believed_m).as_dvec2());
        for ends in &self.history.edges {
            let [Some(a), Some(b)] = ends.map(|end| self.history.node(end)) else { continue };
            rule(scene, at(a.believed_m), at(b.believed_m), &GREY, 0.7, None);
        }
        let fine = self.fine(panel);
        for node in &self.history.nodes {
            let fill = colour::of_uav(node.id.robot.into());
            // Small dots would be all outline.
            let outline = if fine < 0.6 { &fill } else { &INK };
            dot(scene, at(node.believed_m), 2.8 * fine, &fill, outline);
        }
        self.draw_robots(scene, panel);
        unclip(scene);
        panel.axes(scene, "x (m)", "y (m)");
        let spot = legend(scene, panel, 0, "node, by robot");
        dot(scene, spot, 2.8, &colour::of_uav(0), &INK);
        let (x, y) = legend(scene, panel, 1, "edge");
        rule(scene, (x - 8.0, y), (x + 8.0, y), &GREY, 0.9, None);
    }
}
