//! What a renderer draws, and where: usvg, which browsers' behaviour is tested on.

use super::*;

/// Stroked paths by the boxes around them, in px of the page, y down: as usvg sees them.
fn by_usvg(text: &str) -> Vec<[f64; 4]> {
    fn boxes(group: &usvg::Group, into: &mut Vec<[f64; 4]>) {
        for node in group.children() {
            match node {
                usvg::Node::Group(group) => boxes(group, into),
                usvg::Node::Path(path) if path.stroke().is_some() && path.is_visible() => {
                    let around = path.abs_bounding_box();
                    into.push([around.left(), around.top(), around.right(), around.bottom()].map(f64::from));
                }
                _ => {}
            }
        }
    }
    let mut all = Vec::new();
    boxes(usvg::Tree::from_str(text, &usvg::Options::default()).unwrap().root(), &mut all);
    all
}

/// The same of what is read here.
fn by_us(text: &str, [width, height]: [f64; 2]) -> Vec<[f64; 4]> {
    let config = SvgConfig { width_m: Some(width), curve_m: 0.001, ..SvgConfig::default() };
    let drawing = read(text.as_bytes(), &config).unwrap();
    let around = |wall: &crate::map::drawing::Wall| {
        let axis = |axis: usize| wall.line.iter().map(move |at| at[axis]);
        let (low, high) = (
            |of: usize| axis(of).fold(f64::INFINITY, f64::min),
            |of: usize| axis(of).fold(f64::NEG_INFINITY, f64::max),
        );
        [low(0), height - high(1), high(0), height - low(1)]
    };
    drawing.walls.iter().map(around).collect()
}

#[test]
fn everything_stands_where_a_renderer_draws_it() {
    let inside = "\
        <path d='M1 1c2 3 4 5 6 7s1 2 3 4q1 2 3 4t1 2a3 4 30 0 1 5 6'/><path d='M30 5A8 3 20 1 0 35 9L9 9V3h2z'/>\
        <g transform='translate(3,4) rotate(30 5 5) scale(1.5 .5)'><rect x='2' y='3' width='9' height='4' rx='1'/><circle cx='9' cy='2' r='3'/></g>\
        <g transform='skewX(20) matrix(1 .2 -.3 1 4 2)'><ellipse cx='9' cy='8' rx='3' ry='1'/><line x1='1' y1='2' x2='3' y2='9'/></g>\
        <polyline points='1,2 3,4 5,6.5e0 2 1'/><polygon points='10,2 13,4 15,6.5'/>\
        <svg x='20' y='5' width='8' height='6' viewBox='0 0 2 1'><path d='M0 0L2 1'/></svg>\
        <svg x='20' y='5' width='8' height='6' viewBox='-1 -1 2 1' preserveAspectRatio='xMaxYMin slice'><path d='M0 0L.5 -1'/></svg>\
        <defs><g id='a'><path d='M0 0L2 1'/></g><symbol id='s' viewBox='0 0 4 4'><path d='M0 0L2 3'/></symbol></defs>\
        <use href='#a' x='5' y='6' transform='rotate(90)'/><use href='#s' x='3' y='2' width='8' height='5'/>\
        <g style='display:none'><path d='M0 0L2 1'/></g><g visibility='hidden'><path d='M0 0L2 1'/><path visibility='visible' d='M1 1L2 9'/></g>\
        <path d='M5% 10% L9 9'/><rect x='10%' y='5%' width='50%' height='2mm'/>";
    for (head, size) in [
        ("width='400' height='200' viewBox='0 0 40 20'", [400.0, 200.0]),
        ("width='10cm' height='90mm' viewBox='-3 -2 40 20'", [377.952_755, 340.157_48]),
        ("width='300' height='300' viewBox='0 0 40 20' preserveAspectRatio='none'", [300.0, 300.0]),
        ("viewBox='1 2 40 20'", [40.0, 20.0]),
    ] {
        let text = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' {head} fill='none' stroke='black'>{inside}</svg>"
        );
        let (theirs, ours) = (by_usvg(&text), by_us(&text, size));
        assert_eq!((theirs.len(), ours.len()), (14, 14), "{head}");
        for (theirs, ours) in theirs.iter().zip(&ours) {
            let away = theirs.iter().zip(ours).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(away < 2e-3 * size[0].max(40.0) / 40.0, "{head}: {theirs:?}, here {ours:?}");
        }
    }
}
