//! From entities to walls, rock and free space.

use glam::{DAffine2, DVec2};

use super::{
    counts::Counts,
    curves::line_of,
    entity::{Entity, Opened},
    file::File,
    join::{Piece, joined},
};
use crate::map::{
    FRAME_MAX_M, Place,
    drawing::{
        Drawing, MOST_CORNERS, Shape, Solid, Wall,
        reading::{
            curve::Line,
            names::{Kind, kind_of, material_of_layer},
            passage::passage,
        },
    },
    formats::DxfConfig,
};

/// Most entities that are drawn, those of blocks as often as they are inserted; a long one counts for several.
const MOST_VISITS: usize = 300_000;
/// Bytes of an entity that count as another one.
const LONG: usize = 200;
/// Most blocks within each other.
const DEEPEST: usize = 16;
/// Longest name of a place, in letters.
const LONGEST: usize = 80;

/// Where a block is inserted.
#[derive(Debug, Clone, Copy)]
pub(super) struct Inserted<'a> {
    pub(super) to_metres: DAffine2,
    /// The layer of what is on layer 0 within it.
    pub(super) layer: Option<&'a str>,
    pub(super) depth: usize,
}

/// What is drawn so far.
pub(super) struct Pen<'a> {
    pub(super) file: &'a File<'a>,
    pub(super) drawing: Drawing,
    pub(super) config: &'a DxfConfig,
    pub(super) pieces: Vec<Piece<'a>>,
    pub(super) counts: Counts,
    pub(super) visits: usize,
    pub(super) corners: usize,
}

impl<'a> Pen<'a> {
    pub(super) fn all(&mut self, entities: &[Entity<'a>], inserted: &Inserted<'a>) -> Result<(), String> {
        let mut rest = entities.iter();
        while let Some(entity) = rest.next() {
            self.visit(1 + entity.body.len() / LONG)?;
            // Vertices stand as entities of their own after their polyline.
            let own = match entity.kind {
                "POLYLINE" => {
                    let vertices = rest.as_slice();
                    let count = vertices.iter().take_while(|vertex| vertex.kind == "VERTEX").count();
                    rest = vertices[count..].iter();
                    &vertices[..count]
                }
                _ => &[],
            };
            let opened =
                || Ok((entity.open()?, own.iter().map(Entity::open).collect::<Result<Vec<_>, String>>()?));
            let drawn = opened().and_then(|(entity, own)| self.one(&entity, &own, inserted));
            drawn.map_err(|why| {
                let kind: String = entity.kind.chars().take(LONGEST).collect();
                if why.starts_with("line ") { why } else { format!("line {}: {kind}: {why}", entity.line) }
            })?;
        }
        Ok(())
    }

    fn visit(&mut self, entities: usize) -> Result<(), String> {
        self.visits += entities;
        if self.visits <= MOST_VISITS {
            return Ok(());
        }
        Err(format!(
            "more than {MOST_VISITS} entities, with all that is inserted; expected fewer: purge its blocks, or cut it into several"
        ))
    }

    fn one(
        &mut self,
        entity: &Opened<'a>,
        vertices: &[Opened],
        inserted: &Inserted<'a>,
    ) -> Result<(), String> {
        let layer = entity.layer();
        let layer = if layer == "0" { inserted.layer.unwrap_or(layer) } else { layer };
        let kind = kind_of(layer);
        if self.file.dark.contains(layer) || entity.flags(60) == 1 {
            self.counts.dark += 1;
        } else if entity.flags(67) == 1 {
            self.counts.paper += 1;
        } else if kind == Some(Kind::Ignored) || layer.eq_ignore_ascii_case("defpoints") {
            self.counts.ignored += 1;
        } else if entity.kind == "INSERT" {
            return self.insert(entity, layer, inserted);
        } else if matches!(entity.kind, "TEXT" | "MTEXT" | "ATTRIB") && kind == Some(Kind::Place) {
            self.place(entity, inserted);
        } else if matches!(entity.kind, "SOLID" | "TRACE") {
            let corners = [10, 11, 13, 12].map(|code| entity.place(code));
            let points = corners
                .into_iter()
                .flatten()
                .map(|at| (inserted.to_metres * entity.seen()).transform_point2(at));
            let line = self.checked(Line { points: points.collect(), closed: true })?;
            self.area(line, kind, layer);
        } else if let Some((line, width)) =
            line_of(entity, vertices, &inserted.to_metres, self.config.curve_m, MOST_CORNERS)
        {
            let grown = inserted.to_metres.matrix2.determinant().abs().sqrt();
            let width_m = if width * grown > 0.0 { width * grown } else { self.config.wall_m };
            let line = self.checked(line)?;
            if line.points.len() < 2 {
                self.counts.small += 1;
            } else {
                self.pieces.push(Piece { line, layer, width_m });
            }
        } else if entity.kind != "SEQEND" {
            self.counts.drop(entity.kind);
        }
        Ok(())
    }

    fn insert(&mut self, entity: &Opened<'a>, layer: &'a str, inserted: &Inserted<'a>) -> Result<(), String> {
        let file = self.file;
        let Some(block) = entity.text(2).and_then(|name| file.blocks.get(name)) else {
            self.counts.blocks += 1;
            return Ok(());
        };
        if inserted.depth >= DEEPEST {
            return Err(format!(
                "blocks more than {DEEPEST} deep within each other; expected fewer: explode them"
            ));
        }
        let (at, turn) =
            (entity.place(10).unwrap_or_default(), entity.number(50).unwrap_or(0.0).to_radians());
        let scale = DVec2::new(entity.number(41).unwrap_or(1.0), entity.number(42).unwrap_or(1.0));
        let turned = DAffine2::from_cols_array(&[
            libm::cos(turn),
            libm::sin(turn),
            -libm::sin(turn),
            libm::cos(turn),
            0.0,
            0.0,
        ]);
        let count = |code| (entity.flags(code).max(1) as usize).min(MOST_VISITS);
        let step = DVec2::new(entity.number(44).unwrap_or(0.0), entity.number(45).unwrap_or(0.0));
        for row in 0..count(71) {
            for column in 0..count(70) {
                self.visit(1)?;
                let aside = turned.transform_vector2(step * DVec2::new(column as f64, row as f64));
                let placed = DAffine2::from_translation(at + aside)
                    * turned
                    * DAffine2::from_scale(scale)
                    * DAffine2::from_translation(-block.base);
                let to_metres = inserted.to_metres * entity.seen() * placed;
                self.all(
                    &block.entities,
                    &Inserted { to_metres, layer: Some(layer), depth: inserted.depth + 1 },
                )?;
            }
        }
        Ok(())
    }

    fn place(&mut self, entity: &Opened, inserted: &Inserted) {
        let name: String = entity.text(1).unwrap_or_default().trim().chars().take(LONGEST).collect();
        let at = entity.place(10).map(|at| (inserted.to_metres * entity.seen()).transform_point2(at));
        match at.filter(|at| !name.is_empty() && at.x.abs() <= FRAME_MAX_M && at.y.abs() <= FRAME_MAX_M) {
            Some(at) => self.drawing.places.push(Place { name, at_m: at.into(), height_m: None }),
            None => self.counts.small += 1,
        }
    }

    /// A line without corners that are one, all of them places.
    fn checked(&mut self, mut line: Line) -> Result<Line, String> {
        self.corners += line.points.len();
        if self.corners > MOST_CORNERS {
            return Err(format!(
                "more than {MOST_CORNERS} corners; expected fewer: simplify it, or raise curve_m"
            ));
        }
        let is_far = |at: &&DVec2| !(at.x.abs() <= FRAME_MAX_M && at.y.abs() <= FRAME_MAX_M);
        if let Some(at) = line.points.iter().find(is_far) {
            return Err(format!(
                "a corner at ({:e}, {:e}) m; expected numbers within ±{FRAME_MAX_M} m",
                at.x, at.y
            ));
        }
        line.points.dedup();
        Ok(line)
    }

    fn material(&mut self, layer: &str) -> Option<usize> {
        material_of_layer(layer).map(|name| self.drawing.material(&name, None))
    }

    fn area(&mut self, line: Line, kind: Option<Kind>, layer: &str) {
        let shape = Shape { outline: line.points.into_iter().map(Into::into).collect(), holes: Vec::new() };
        if shape.outline.len() < 3 {
            self.counts.small += 1;
        } else if kind == Some(Kind::Free) {
            self.drawing.free.push(shape);
        } else {
            let material = self.material(layer);
            self.drawing.solids.push(Solid { shape, material });
        }
    }

    /// The drawing, once lines that meet are joined.
    pub(super) fn finished(mut self) -> Result<Drawing, String> {
        let before = self.pieces.len();
        let pieces = joined(std::mem::take(&mut self.pieces), self.config.snap_m);
        let merged = before - pieces.len();
        for Piece { line, layer, width_m } in pieces {
            let kind = kind_of(layer);
            if line.closed && matches!(kind, Some(Kind::Free | Kind::Rock)) {
                self.area(line, kind, layer);
                continue;
            }
            let (closed, points) =
                (line.closed, line.points.into_iter().map(Into::into).collect::<Vec<[f64; 2]>>());
            if kind == Some(Kind::Free) {
                self.corners += 20 * points.len();
                self.drawing.free.extend(passage(&points, closed, width_m));
            } else {
                let material = self.material(layer);
                self.drawing.walls.push(Wall { line: points, closed, thickness_m: width_m, material });
            }
        }
        self.counts.said(self.drawing, merged)
    }
}
