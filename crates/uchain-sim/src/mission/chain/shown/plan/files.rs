//! Where the relays stand, for other programs: a table, and `GeoJSON`.

use std::fmt::Write as _;

use crate::{
    map::Map,
    mission::chain::{Everywhere, Place, Plan},
};

/// A row per relay (`places.csv`), the one next to the head first. What nobody knows is empty.
pub fn places_csv(plan: &Plan) -> String {
    let mut text =
        "relay,x_m,y_m,depth_m,link_db,front_db,margin_db,launch_min,airborne_min,spare_min\n".to_owned();
    for place in &plan.places {
        let fixed = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.3}"));
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{},{:.4},{:.4},{:.4},{:.3},{:.3},{:.3},{},{},{}",
            place.relay,
            place.x_m,
            place.y_m,
            place.depth_m,
            place.link_db,
            place.front_db,
            place.margin_db,
            fixed(place.launch_min),
            fixed(place.airborne_min),
            fixed(place.spare_min),
        );
    }
    text
}

/// Base, relays, goal and the links between them as `GeoJSON` (`places.geojson`): longitude and latitude where the map's file
/// says where on Earth it lies, else metres of the file's own frame.
pub fn places_geojson(plan: &Plan, map: &Map) -> String {
    let base_m = plan.assumptions.map.base_m;
    let place = |at_m: [f64; 2]| map.import().to_degrees(at_m).unwrap_or(at_m);
    let is_in_degrees = map.import().about_deg.is_some();
    // A tenth of a millimetre, and a millimetre of a degree.
    let decimals = if is_in_degrees { 8 } else { 4 };
    let shown = |at_m: [f64; 2]| {
        let [x, y] = place(at_m);
        format!("[{x:.decimals$}, {y:.decimals$}]")
    };
    let point = |at_m: [f64; 2], properties: &str| point(&shown(at_m), properties);
    let link = |from_m: [f64; 2], to_m: [f64; 2], loss_db, s_min_db| {
        link(&shown(from_m), &shown(to_m), loss_db, s_min_db)
    };
    let head = plan.head_m;
    let mut features = vec![point(base_m, "\"kind\": \"base\", \"depth_m\": 0")];
    let relay = |place: &Place| {
        let properties = format!(
            "\"kind\": \"relay\", \"relay\": {}, \"depth_m\": {:.4}, \"margin_db\": {:.3}",
            place.relay, place.depth_m, place.margin_db
        );
        point([place.x_m, place.y_m], &properties)
    };
    features.extend(plan.places.iter().rev().map(relay));
    if let Some((at_m, depth_m)) = head.zip(plan.rows.last().map(|row| row.depth_m)) {
        features.push(point(at_m, &format!("\"kind\": \"head\", \"depth_m\": {depth_m:.4}")));
    }
    let mut front = head;
    for place in &plan.places {
        if let Some(front_m) = front {
            features.push(link(front_m, [place.x_m, place.y_m], place.front_db, plan.s_min_db));
        }
        front = Some([place.x_m, place.y_m]);
    }
    if let Some((front_m, last)) = front.zip(plan.places.last()) {
        features.push(link(front_m, base_m, last.link_db, plan.s_min_db));
    }
    let units = if is_in_degrees { "" } else { "\"units\": \"m\", " };
    format!("{{\"type\": \"FeatureCollection\", {units}\"features\": [\n{}\n]}}\n", features.join(",\n"))
}

/// A row per cell that can be reached (`everywhere.csv`): its middle in the map file's own frame, how far it is from the base,
/// and the relays that a head there needs, empty where no number is enough.
pub fn everywhere_csv(map: &Map, everywhere: &Everywhere) -> String {
    let [left_m, bottom_m] = map.offset_m();
    let mut text = "x_m,y_m,depth_m,relays\n".to_owned();
    for cell in &everywhere.cells {
        let (x_m, y_m) = (f64::from(cell.at.x) + left_m, f64::from(cell.at.y) + bottom_m);
        let relays = cell.relays.map_or_else(String::new, |relays| relays.to_string());
        let _ = writeln!(text, "{x_m:.3},{y_m:.3},{:.3},{relays}", cell.depth_m);
    }
    text
}

fn point(at: &str, properties: &str) -> String {
    feature(&format!("{{\"type\": \"Point\", \"coordinates\": {at}}}"), properties)
}

fn link(from: &str, to: &str, loss_db: f64, s_min_db: f64) -> String {
    let geometry = format!("{{\"type\": \"LineString\", \"coordinates\": [{from}, {to}]}}");
    let margin_db = s_min_db - loss_db;
    feature(
        &geometry,
        &format!("\"kind\": \"link\", \"loss_db\": {loss_db:.3}, \"margin_db\": {margin_db:.3}"),
    )
}

fn feature(geometry: &str, properties: &str) -> String {
    format!("  {{\"type\": \"Feature\", \"geometry\": {geometry}, \"properties\": {{{properties}}}}}")
}
