//! One pair of axes at a fixed place on the page, and the marks that go with it.

use kuva::render::{
    axis::add_axes_and_grid,
    color::Color,
    layout::{ComputedLayout, Layout},
    render::{Primitive, Scene, TextAnchor},
};

use super::colour::INK;

/// Width of the page.
pub(crate) const FIGURE_WIDTH: f64 = 700.0;
/// Room left of the axes for numbers and the label.
pub(crate) const LEFT: f64 = 54.0;
/// Room right of the axes for the legend.
const RIGHT: f64 = 112.0;
/// Width of the axes' box.
pub(crate) const BOX_WIDTH: f64 = FIGURE_WIDTH - LEFT - RIGHT;

/// Size of the headline.
pub(crate) const TEXT_LARGE: u32 = 13;
/// Size of axis labels.
pub(crate) const TEXT_LABEL: u32 = 11;
/// Size of numbers and legends.
pub(crate) const TEXT_SMALL: u32 = 10;
/// Width of a letter of that size, most of them.
pub(crate) const LETTER: f64 = 5.8;

/// A pair of axes.
pub(crate) struct Panel {
    ranges: [(f64, f64); 2],
    layout: Layout,
    computed: ComputedLayout,
}

impl Panel {
    /// Axes with a grid, whose box starts `top` below the page's upper edge.
    pub(crate) fn new(top: f64, height: f64, x_range: (f64, f64), y_range: (f64, f64)) -> Self {
        Self::within((LEFT, FIGURE_WIDTH - RIGHT), top, height, x_range, y_range)
    }

    /// The same between two places across the page.
    pub(crate) fn within(
        across: (f64, f64),
        top: f64,
        height: f64,
        x_range: (f64, f64),
        y_range: (f64, f64),
    ) -> Self {
        Self::on_page(FIGURE_WIDTH, across, top, height, x_range, y_range)
    }

    /// The same on a page of another width.
    pub(crate) fn on_page(
        page: f64,
        (left, right): (f64, f64),
        top: f64,
        height: f64,
        x_range: (f64, f64),
        y_range: (f64, f64),
    ) -> Self {
        let layout = Layout::new(x_range, y_range)
            .with_width(page)
            .with_height(top + height)
            .with_force_margins(left, page - right)
            .with_force_margins_y(top, 0.0)
            .with_x_axis_min(x_range.0)
            .with_x_axis_max(x_range.1)
            .with_y_axis_min(y_range.0)
            .with_y_axis_max(y_range.1)
            .with_tick_size(TEXT_SMALL)
            .with_box_axes();
        let computed = ComputedLayout::from_layout(&layout);
        Self { ranges: [x_range, y_range], layout, computed }
    }

    /// The same without a grid.
    pub(crate) fn without_grid(mut self) -> Self {
        self.layout.show_grid = false;
        self
    }

    /// The same with numbers on the vertical axis so far apart.
    pub(crate) fn with_y_step(mut self, step: f64) -> Self {
        self.layout = self.layout.with_y_tick_step(step);
        self.computed = ComputedLayout::from_layout(&self.layout);
        self
    }

    /// The same with numbers on the horizontal axis so far apart.
    pub(crate) fn with_x_step(mut self, step: f64) -> Self {
        self.layout = self.layout.with_x_tick_step(step);
        self.computed = ComputedLayout::from_layout(&self.layout);
        self
    }

    /// The same with words instead of numbers on the horizontal axis, at 1, 2, 3 and so on.
    #[cfg(any(feature = "sweep", feature = "fit"))]
    pub(crate) fn with_words(mut self, words: Vec<String>) -> Self {
        self.layout = self.layout.with_x_categories(words);
        self
    }

    pub(crate) fn left(&self) -> f64 {
        self.computed.margin_left
    }

    pub(crate) fn right(&self) -> f64 {
        self.computed.width - self.computed.margin_right
    }

    pub(crate) fn top(&self) -> f64 {
        self.computed.margin_top
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.computed.height - self.computed.margin_bottom
    }

    /// What its lower left and its upper right corner show.
    pub(crate) fn ranges(&self) -> ((f64, f64), (f64, f64)) {
        let [x, y] = self.ranges;
        ((x.0, y.0), (x.1, y.1))
    }

    /// Where a value lies on the page.
    pub(crate) fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (self.computed.map_x(x), self.computed.map_y(y))
    }

    /// Whether a value lies within the axes.
    pub(crate) fn shows(&self, y: f64) -> bool {
        (self.top()..=self.bottom()).contains(&self.computed.map_y(y))
    }

    /// The grid, the box, its numbers and labels.
    pub(crate) fn axes(&self, scene: &mut Scene, x_label: &str, y_label: &str) {
        self.grid(scene);
        name_axes(scene, self, self, x_label, y_label);
    }

    /// The grid, the box and its numbers.
    pub(crate) fn grid(&self, scene: &mut Scene) {
        add_axes_and_grid(scene, &self.computed, &self.layout);
    }

    /// Nothing that follows leaves the box, until [`unclip`].
    pub(crate) fn clip(&self, scene: &mut Scene) {
        let (x, y) = (self.left(), self.top());
        let (width, height) = (self.right() - x, self.bottom() - y);
        scene.add(Primitive::ClipStart { x, y, width, height, id: format!("box{x}-{y}") });
    }

    /// A line through values; a gap wherever a value is missing.
    pub(crate) fn line(
        &self,
        scene: &mut Scene,
        values: impl Iterator<Item = Option<(f64, f64)>>,
        stroke: &Color,
        width: f64,
    ) {
        let mut points = Vec::new();
        for value in values.chain([None]) {
            match value {
                Some((x, y)) => points.push(self.at(x, y)),
                None if points.len() > 1 => scene.add(Primitive::PolyLine {
                    points: std::mem::take(&mut points),
                    stroke: stroke.clone(),
                    stroke_width: width,
                    stroke_dasharray: None,
                }),
                None => points.clear(),
            }
        }
    }
}

/// Labels of the axes of boxes that share them: of one, or of all from the upper left to the lower right one.
pub(crate) fn name_axes(scene: &mut Scene, first: &Panel, last: &Panel, x_label: &str, y_label: &str) {
    let middle = (f64::midpoint(first.left(), last.right()), f64::midpoint(first.top(), last.bottom()));
    scene.add(label((middle.0, last.bottom() + 33.0), x_label, None));
    scene.add(label((first.left() - 40.0, middle.1), y_label, Some(-90.0)));
}

/// A round number, so that at most so many of its multiples lie within a span.
pub(crate) fn round_step(span: f64, most: usize) -> f64 {
    let least = (span / most.max(1) as f64).max(1e-9);
    let power = libm::exp10(libm::log10(least).floor());
    [1.0, 2.0, 5.0].map(|digit| digit * power).into_iter().find(|step| *step >= least).unwrap_or(10.0 * power)
}

/// Ends what [`Panel::clip`] began.
pub(crate) fn unclip(scene: &mut Scene) {
    scene.add(Primitive::ClipEnd);
}

/// A straight line on the page.
pub(crate) fn rule(
    scene: &mut Scene,
    (x1, y1): (f64, f64),
    (x2, y2): (f64, f64),
    stroke: &Color,
    width: f64,
    dash: Option<&str>,
) {
    scene.add(Primitive::Line {
        x1,
        y1,
        x2,
        y2,
        stroke: stroke.clone(),
        stroke_width: width,
        stroke_dasharray: dash.map(str::to_owned),
    });
}

/// A round mark on the page.
pub(crate) fn dot(scene: &mut Scene, (cx, cy): (f64, f64), r: f64, fill: &Color, stroke: &Color) {
    scene.add(Primitive::Circle {
        cx,
        cy,
        r,
        fill: fill.clone(),
        fill_opacity: None,
        stroke: Some(stroke.clone()),
        stroke_width: Some(1.0),
    });
}

/// Text that starts at a point of the page.
pub(crate) fn text(scene: &mut Scene, (x, y): (f64, f64), size: u32, content: &str) {
    scene.add(Primitive::Text {
        x,
        y,
        content: content.to_owned(),
        size,
        anchor: TextAnchor::Start,
        rotate: None,
        bold: false,
        color: Some(INK),
    });
}

/// Small text centred on a point of the page.
pub(crate) fn caption(scene: &mut Scene, (x, y): (f64, f64), content: &str, colour: &Color) {
    scene.add(Primitive::Text {
        x,
        y,
        content: content.to_owned(),
        size: TEXT_SMALL,
        anchor: TextAnchor::Middle,
        rotate: None,
        bold: false,
        color: Some(colour.clone()),
    });
}

/// The range of some values, with room around them; one value has room as well, and none is 0 to 1.
#[cfg(any(feature = "sweep", feature = "log", feature = "fit"))]
pub(crate) fn widened(values: impl Iterator<Item = f64>, share: f64) -> (f64, f64) {
    let finite = values.filter(|value| value.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    if low > high {
        return (0.0, 1.0);
    }
    let room = if high > low { share * (high - low) } else { (0.05 * high.abs()).max(0.5) };
    (low - room, high + room)
}

fn label((x, y): (f64, f64), content: &str, rotate: Option<f64>) -> Primitive {
    Primitive::Text {
        x,
        y,
        content: content.to_owned(),
        size: TEXT_LABEL,
        anchor: TextAnchor::Middle,
        rotate,
        bold: false,
        color: Some(INK),
    }
}
