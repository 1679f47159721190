//! Links only if nothing in here can panic, whatever it is given: every law of the chain by itself, a node as a whole, and
//! packets. What the compiler is given is hidden from it, so that it has to prove it for all values.
//!
//! A function marked `no_panic` calls, where a panic would leave it, a function that does not exist.

mod laws;
mod node;
mod wire;

fn main() {
    println!("{:?}", (laws::all(), node::all(), wire::all()));
}
