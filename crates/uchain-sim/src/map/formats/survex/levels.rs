//! Which passages lie over one another: a map is flat, so two that cross at different heights cannot both be in it.

use super::{
    cave::Cave,
    convex::{Plan, bounds, nearest, overlap},
};

/// Most pairs of passages whose boxes are compared, and most whose outlines are.
const MOST_BOXES: usize = 100_000_000;
const MOST_OUTLINES: usize = 300_000;
/// Most stations looked at to find whether two passages are neighbours, and most looks for all passages.
const MOST_LOOKED_AT: usize = 256;
const MOST_LOOKS: usize = 100_000_000;

/// A passage that covers another in plan, and not because both meet there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cover {
    pub(super) other: usize,
    /// How much higher one is than the other (m).
    pub(super) gap_m: f64,
}

/// For each passage, what it covers among the chosen ones.
pub(super) fn covers(cave: &Cave, chosen: &[usize]) -> Result<Vec<Vec<Cover>>, String> {
    let mut boxes: Vec<(usize, Vec<Plan>, [Plan; 2])> = Vec::with_capacity(chosen.len());
    for &passage in chosen {
        let ends = cave.passages[passage].ends;
        let around = ends.iter().flat_map(|&node| {
            // Where only a few meet, the room they meet in counts too.
            let here =
                cave.nodes[node].passages.iter().copied().filter(|_| cave.nodes[node].passages.len() <= 8);
            cave.joint(node, here.chain([passage]))
        });
        let outline = super::convex::hull(around.collect());
        let bounds = bounds(&outline);
        boxes.push((passage, outline, bounds));
    }
    boxes.sort_by(|a, b| a.2[0][0].total_cmp(&b.2[0][0]).then(a.0.cmp(&b.0)));
    let mut covers = vec![Vec::new(); cave.passages.len()];
    let (mut compared, mut outlines, mut looks) = (0, 0, 0);
    for (at, (a, outline, [low, high])) in boxes.iter().enumerate() {
        for (b, other, [other_low, other_high]) in boxes.iter().skip(at + 1) {
            compared += 1;
            if other_low[0] > high[0] {
                break;
            }
            if other_low[1] > high[1] || other_high[1] < low[1] {
                continue;
            }
            outlines += 1;
            if compared > MOST_BOXES || outlines > MOST_OUTLINES || looks > MOST_LOOKS {
                return Err(format!(
                    "too many of {} legs lie close together: more than {MOST_OUTLINES} pairs of them; expected a cave, or a part \
                     of it by the keys from and to",
                    chosen.len()
                ));
            }
            if overlap(outline, other) && !neighbours(cave, *a, *b, &mut looks) {
                let gap_m = gap_m(cave, *a, *b);
                covers[*a].push(Cover { other: *b, gap_m });
                covers[*b].push(Cover { other: *a, gap_m });
            }
        }
    }
    Ok(covers)
}

/// Whether the way from one to the other along the survey is so short, in plan, that both are one blob anyway.
fn neighbours(cave: &Cave, a: usize, b: usize, looks: &mut usize) -> bool {
    let [a, b] = [&cave.passages[a], &cave.passages[b]];
    if a.ends.iter().any(|end| b.ends.contains(end)) {
        return true;
    }
    let farthest_m = a.width_m() + b.width_m();
    // Few, so a list does.
    let mut seen: Vec<(usize, f64)> = a.ends.iter().map(|&end| (end, 0.0)).collect();
    let mut at = 0;
    while let Some(&(node, so_far_m)) = seen.get(at) {
        at += 1;
        for &next in cave.nodes[node].passages.iter().take(MOST_LOOKED_AT) {
            let next = &cave.passages[next];
            *looks += seen.len();
            let (end, way_m) = (next.other(node), so_far_m + next.plan_m);
            if way_m > farthest_m || seen.iter().any(|&(known, known_m)| known == end && known_m <= way_m) {
                continue;
            }
            if b.ends.contains(&end) {
                return true;
            }
            if seen.len() >= MOST_LOOKED_AT {
                return false;
            }
            seen.push((end, way_m));
        }
    }
    false
}

/// How much higher one is than the other where they come nearest in plan (m).
fn gap_m(cave: &Cave, a: usize, b: usize) -> f64 {
    let shares = nearest(cave.line(a), cave.line(b));
    let height_m = |passage: usize, share: f64| {
        let [from_m, to_m] = cave.passages[passage].ends.map(|end| cave.nodes[end].at_m[2]);
        from_m + share * (to_m - from_m)
    };
    (height_m(a, shares[0]) - height_m(b, shares[1])).abs()
}
