//! Explorations end, at home, with everything seen and nothing touched.

use std::thread;

use uchain_core::explore::Strategy;
use uchain_sim::{
    analyse::explore::ExploreSummary,
    config::{Site, builtin},
    run::explore,
};

fn site(name: &str, sets: &[String]) -> Site {
    Site::read(&builtin(name).expect("a compiled-in scenario"), sets).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn probe() {
    let start = std::time::Instant::now();
    for map in ["apartment", "corridors"] {
        for strategy in ["cssg", "cssg-random", "srg"] {
            for n in 1..=6 {
                let site = site(map, &[format!("explore.robots={n}"), format!("explore.strategy={strategy}")]);
                let all: Vec<ExploreSummary> = thread::scope(|s| {
                    let hs: Vec<_> = (0..2u64).map(|h| { let site = &site; s.spawn(move || (0..10).map(|k| explore(site, 1 + h * 10 + k, &mut ()).unwrap().0).collect::<Vec<_>>()) }).collect();
                    hs.into_iter().flat_map(|h| h.join().unwrap()).collect()
                });
                let mean = |f: &dyn Fn(&ExploreSummary) -> f64| all.iter().map(f).sum::<f64>() / all.len() as f64;
                let stops: std::collections::BTreeSet<String> = all.iter().map(|s| format!("{:?}", s.stopped)).collect();
                println!("{map} {strategy} {n}: it {:.1} m {:.2} cov {:.4} min {:.4} mfl {:.1} s {:.0} holds {:.1} overlap {:.3} bal {:.2} nodes {:.0} contacts w{} r{} hubs {} {:?}",
                    mean(&|s| s.iterations.into()), mean(&|s| s.distance_mean_m()), mean(&|s| s.coverage), all.iter().map(|s| s.coverage).fold(1.0, f64::min),
                    mean(&|s| s.mfl_s), mean(&|s| s.sim_s), mean(&|s| s.holds.iter().sum::<u32>().into()), mean(&|s| s.overlap), mean(&|s| s.balance),  mean(&|s| s.nodes.iter().sum::<u32>().into()),
                    all.iter().map(|s| s.wall_contacts).sum::<u32>(), all.iter().map(|s| s.robot_contacts).sum::<u32>(), all.iter().map(|s| s.hubs_left).sum::<u32>(), stops);
            }
        }
        println!("{:?}", start.elapsed());
    }
    let _ = Strategy::Cssg;
}
