//! A map as GeoJSON, in metres.

use std::fmt::Write as _;

use glam::DVec2;
use serde_json::{Value, json};

use super::parts::{Parts, Rock};
use crate::map::Map;

/// The map as GeoJSON, for a GIS, and for `[map.geojson]`, which reads every wall again within a millimetre: free areas, rock with
/// its `material` and `loss_db`, places as points. Coordinates are metres of the map file's own frame (`"units": "m"`); where that
/// lies on Earth, if it is known, and how the map was read is kept in a member `uchain`.
#[must_use]
pub fn write_geojson(map: &Map) -> String {
    let parts = Parts::of(map);
    let import = map.import();
    let own = json!({"about_deg": import.about_deg, "import": import});
    let mut text =
        format!("{{\"type\":\"FeatureCollection\",\"units\":\"m\",\"uchain\":{own},\"features\":[");
    let mut next = "";
    for outline in &parts.free {
        text.push_str(next);
        area(&mut text, map, std::slice::from_ref(outline), &json!({"kind": "free"}));
        next = ",";
    }
    for Rock { rings, material } in &parts.rock {
        let mut said = json!({"kind": "rock"});
        if let Some(material) = material {
            said["material"] = material.name.clone().into();
            if let Some(loss_db) = material.loss_db {
                said["loss_db"] = loss_db.into();
            }
        }
        text.push_str(next);
        area(&mut text, map, rings, &said);
        next = ",";
    }
    for place in map.places() {
        let [x, y] = place.at_m;
        let at = place.height_m.map_or_else(|| json!([x, y]), |height_m| json!([x, y, height_m]));
        let place = json!({"kind": "place", "name": place.name});
        feature(&mut text, next, &place, &json!({"type": "Point", "coordinates": at}).to_string());
        next = ",";
    }
    text.push_str("\n]}\n");
    text
}

fn feature(text: &mut String, before: &str, properties: &Value, geometry: &str) {
    let _ = write!(
        text,
        "{before}\n{{\"type\":\"Feature\",\"properties\":{properties},\"geometry\":{geometry}}}"
    );
}

fn area(text: &mut String, map: &Map, rings: &[Vec<DVec2>], properties: &Value) {
    let [x, y] = map.offset_m();
    let mut places = String::new();
    for (index, ring) in rings.iter().enumerate() {
        places.push_str(if index == 0 { "[" } else { ",[" });
        // A ring of GeoJSON ends where it begins.
        for (index, at) in ring.iter().chain(ring.first()).enumerate() {
            let _ = write!(places, "{}[{:.5},{:.5}]", if index == 0 { "" } else { "," }, at.x + x, at.y + y);
        }
        places.push(']');
    }
    feature(text, "", properties, &format!("{{\"type\":\"Polygon\",\"coordinates\":[{places}]}}"));
}
