//! Ways through the roadmap, against another implementation of Dijkstra's algorithm.

use petgraph::{algo::dijkstra, graph::UnGraph};
use proptest::prelude::*;
use uchain_core::explore::{Dijkstra, Graph};

/// Edges of a random graph: two nodes and a length.
fn edges() -> impl Strategy<Value = (usize, Vec<(usize, usize, f32)>)> {
    (1..40_usize).prop_flat_map(|nodes| {
        // Some lengths are 0, and many ways are equally long.
        let length_m = prop_oneof![0.0..1.0_f32, Just(0.0), Just(0.5)];
        let edge = (0..nodes, 0..nodes, length_m);
        (Just(nodes), prop::collection::vec(edge, 0..120))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn distances_are_petgraphs_and_every_first_step_leads_on(
        (nodes, edges) in edges(), searches in prop::collection::vec(any::<prop::sample::Index>(), 1..4),
    ) {
        let (mut graph, mut oracle) = (Graph::default(), UnGraph::<(), f32>::new_undirected());
        let known: Vec<_> = (0..nodes).map(|i| { graph.push(i as u64); oracle.add_node(()) }).collect();
        for &(a, b, length_m) in &edges {
            if a != b && !graph.linked(a, b) {
                oracle.add_edge(known[a], known[b], length_m);
            }
            graph.link(a, b, length_m);
        }
        prop_assert_eq!((graph.nodes(), graph.edges()), (oracle.node_count(), oracle.edge_count()));
        let mut routes = Dijkstra::default();
        for from in searches.iter().map(|i| i.index(nodes)) {
            let mut order = Vec::new();
            routes.search(&graph, from, |node, distance_m| { order.push((node, distance_m)); false });
            prop_assert!(order.windows(2).all(|pair| pair[0].1 <= pair[1].1), "nearest first");
            let expected = dijkstra(&oracle, known[from], None, |edge| *edge.weight());
            prop_assert_eq!(order.len(), expected.len());
            for (node, known) in known.iter().enumerate() {
                prop_assert_eq!(routes.distance_m(node), expected.get(known).copied());
                let Some(distance_m) = routes.distance_m(node) else {
                    prop_assert_eq!(routes.first_step(node), None);
                    continue;
                };
                // Whoever takes first step after first step comes there, in no more steps than there are nodes.
                let (mut at, mut steps, mut flown_m) = (from, 0, 0.0_f64);
                while at != node {
                    routes.search(&graph, at, |_, _| false);
                    let next = routes.first_step(node).unwrap();
                    flown_m += f64::from(graph.neighbours(at).find(|(to, _)| *to == next).unwrap().1);
                    (at, steps) = (next, steps + 1);
                    prop_assert!(steps < nodes, "round and round");
                }
                prop_assert!((flown_m - f64::from(distance_m)).abs() < 1e-4);
                routes.search(&graph, from, |_, _| false);
            }
        }
    }

    #[test]
    fn a_search_that_is_enough_knows_what_is_nearer_and_nothing_else((nodes, edges) in edges(), limit_m in 0.0..2.0_f32) {
        let mut graph = Graph::default();
        (0..nodes).for_each(|i| graph.push(i as u64));
        for (a, b, length_m) in edges {
            graph.link(a, b, length_m);
        }
        let (mut whole, mut part) = (Dijkstra::default(), Dijkstra::default());
        whole.search(&graph, 0, |_, _| false);
        part.search(&graph, 0, |_, distance_m| distance_m > limit_m);
        for node in 0..nodes {
            match whole.distance_m(node) {
                Some(distance_m) if distance_m <= limit_m => {
                    prop_assert_eq!(part.distance_m(node), Some(distance_m));
                    prop_assert_eq!(part.first_step(node), whole.first_step(node));
                }
                other => prop_assert!(part.distance_m(node).is_none() || part.distance_m(node) == other),
            }
        }
    }
}

#[test]
fn links_that_make_no_sense_are_not_made() {
    let mut graph = Graph::default();
    graph.push(0);
    graph.push(1);
    for (a, b, length_m) in
        [(0, 0, 1.0), (0, 2, 1.0), (9, 0, 1.0), (0, 1, -1.0), (0, 1, f32::NAN), (0, 1, f32::INFINITY)]
    {
        graph.link(a, b, length_m);
    }
    assert_eq!((graph.edges(), graph.neighbours(usize::MAX).count()), (0, 0));
    let mut routes = Dijkstra::default();
    routes.search(&graph, usize::MAX, |_, _| false);
    assert_eq!((routes.distance_m(0), routes.first_step(usize::MAX)), (None, None));
}
