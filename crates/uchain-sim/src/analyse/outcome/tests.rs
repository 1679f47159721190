use super::*;

const WAY: Way = Way { asked_m: 10.0, flown_m: 9.0, is_end: false };
const OVER: Over = Over { over: 8, links: 8, worst_db: 65.94, s_min_db: 60.0 };

const SAID: [&str; 18] = [
    "interrupted: ended early, after 3.00 s of 120 s",
    "never-flew: the head never took off",
    "head-failed: the head failed at 80.00 s",
    "chain-broken: the chain was broken at the end, in 1 of 3 links: the link of UAV 1 toward the base loses 101.3 dB, and reception ends at 100 dB",
    "head-stuck: the head was stuck for 26.0 s, last from 20.0 s on at (4.00, 0.50) m: it was let fly and stayed where it was; 9.0 of 10.0 m flown",
    "not-launched: none of 39 relays took off, and 8 of 8 links over 60 dB, the worst 65.9 dB",
    "relays-short: 5 relays short: 7 in the air, 12 needed, and 8 of 8 links over 60 dB, the worst 65.9 dB",
    "head-held: the head was held back by its link: 9.0 of 10.0 m flown; 0.8 m were withheld in 4.0 s",
    "head-short: the head did not get as far as asked: 9.0 of 10.0 m flown; slowing down near walls cost 0.4 m",
    "links-over: the chain was not level: 8 of 8 links over 60 dB, the worst 65.9 dB",
    "stuck: 52.0 % seen when nobody moved any more, at 30.0 s, and not all were home",
    "full: 52.0 % seen, all home, 3 nodes with a frontier left and no room for more nodes (explore.nodes_max)",
    "time-up: 52.0 % seen when the time was up, after 600 s (duration_s)",
    "unreachable: 52.0 % seen, all home, and 1 node with a frontier left that nobody finds a way to",
    "unseen: 52.0 % seen, 46.0 % behind passages narrower than 0.90 m, 2.0 % unseen elsewhere, the largest piece 7.6 m2 around (3.50, 2.00) m: --set explore.sectors=36 looks through 0.90 m",
    "astray: nobody came round the ring",
    "completed: 9.0 of 10.0 m flown; 3 links within 60 dB, the worst 57.8 dB",
    "explored: 52.0 % seen, no frontier left, all home",
];

fn own(is_success: bool) -> Outcome {
    Outcome::Own { word: "astray", words: "nobody came round the ring".to_owned(), is_success }
}

fn all() -> Vec<Outcome> {
    let seen = 0.52;
    let loss = Break::Loss { loss_db: 101.26, limit_db: 100.0 };
    vec![
        Outcome::Interrupted { at_s: 3.0, of_s: Some(120.0) },
        Outcome::NeverFlew,
        Outcome::HeadFailed { at_s: 80.0 },
        Outcome::ChainBroken { broken: 1, links: 3, uav: 1, cause: loss },
        Outcome::HeadStuck { way: WAY, from_s: 20.0, stuck_s: 26.0, at_m: [4.0, 0.5] },
        Outcome::NotLaunched { waiting: 39, used: 0, over: OVER },
        Outcome::RelaysShort { short: Some(5), used: 7, over: OVER },
        Outcome::HeadHeld { way: WAY, held_m: 0.8, held_s: 4.0 },
        Outcome::HeadShort { way: WAY, slowed_m: 0.4 },
        Outcome::LinksOver(OVER),
        Outcome::Stuck { seen, at_s: 30.0 },
        Outcome::Full { seen, hubs: 3 },
        Outcome::TimeUp { seen, after_s: 600.0 },
        Outcome::Unreachable { seen, hubs: 1 },
        Outcome::Unseen {
            seen,
            behind: 0.46,
            narrow_m: 0.898,
            piece_m: [3.5, 2.0],
            piece_m2: 7.6,
            remedy: Some(Remedy { sets: "--set explore.sectors=36".to_owned(), width_m: Some(0.898) }),
        },
        own(false),
        Outcome::Completed { way: Some(WAY), links: 3, worst_db: Some(57.83), s_min_db: 60.0 },
        Outcome::Explored { seen },
    ]
}

#[test]
fn every_outcome_has_a_word_of_its_own_and_words_with_its_numbers() {
    let said: Vec<String> = all().iter().map(|outcome| format!("{}: {outcome}", outcome.word())).collect();
    assert_eq!(said, SAID, "{}", said.join("\n"));
    let mut words: Vec<&str> = all().iter().map(Outcome::word).collect();
    words.sort_unstable();
    words.dedup();
    assert_eq!(words.len(), all().len());
}

#[test]
fn only_what_came_as_asked_is_a_success() {
    let good: Vec<&str> = all().iter().filter(|outcome| outcome.is_success()).map(Outcome::word).collect();
    assert_eq!(good, ["completed", "explored"]);
    assert!(own(true).is_success(), "a mission's own finding is what it says it is");
}

#[test]
fn the_gravest_finding_is_the_outcome_and_the_others_are_said_after_it() {
    let good = Outcome::Explored { seen: 1.0 };
    let mut mixed = all();
    mixed.retain(|outcome| !outcome.is_success());
    mixed.reverse();
    let verdict = Verdict::new(good.clone(), mixed, vec!["UAV 1 failed at 3.00 s".to_owned()]);
    assert_eq!(verdict.outcome().word(), "interrupted");
    let order: Vec<&str> = verdict.findings().map(Outcome::word).collect();
    assert_eq!(order, all().iter().map(Outcome::word).take(order.len()).collect::<Vec<_>>());
    assert!(verdict.to_string().ends_with("; UAV 1 failed at 3.00 s"));
    assert!(Verdict::new(good, Vec::new(), Vec::new()).outcome().is_success());
}

#[test]
fn in_a_file_it_is_a_word_and_words() {
    let verdict = Verdict::new(Outcome::NeverFlew, Vec::new(), Vec::new());
    let text = toml::to_string(&verdict).unwrap();
    assert_eq!(text, "outcome = \"never-flew\"\nverdict = \"the head never took off\"\n");
}

#[test]
fn a_share_that_is_not_all_does_not_read_as_all() {
    let words = |seen| Outcome::Explored { seen }.to_string();
    assert!(words(1.0).starts_with("100 % seen"));
    assert!(words(0.9999).starts_with("99.9 % seen"));
    assert!(words(0.99).starts_with("99.0 % seen"));
}
