//! The simulation in a browser: one flight, to watch, to steer, and to ask why. The page (`web/`) draws and listens; every
//! law, every law of nature and every word about them is here, in the same code that flies everywhere else, so that a
//! flight on the page has the bits of the same flight on the command line.
//!
//! A page asks in JSON, `{"do":"advance","ticks":20}`, perhaps with a byte 0 and files behind it, and is answered in JSON:
//! `{"ok":…}` or `{"error":{"message":…,"line":…,"key":…}}`. Numbers over time and files come besides, as bytes:
//! [`Engine::payload`]. [`Engine::call`] is all there is; `wasm.rs` hands it to a page.
//!
//! ```
//! let mut engine = uchain_view::Engine::default();
//! let text = uchain_sim::config::builtin("corner").unwrap().text;
//! let open = serde_json::json!({"do": "open", "flight": {"kind": "scenario", "label": "corner", "text": text, "seed": 1}});
//! let mut ask = |what: &str| -> serde_json::Value { serde_json::from_slice(&engine.call(what.as_bytes())).unwrap() };
//! assert_eq!(ask(&open.to_string())["ok"]["crew"], 4);
//! assert_eq!(ask(r#"{"do":"advance","ticks":20}"#)["ok"]["tick"], 20);
//! assert_eq!(ask(r#"{"do":"frame","tick":20}"#)["ok"]["time_s"], 1.0);
//! assert!(ask(r#"{"do":"fly"}"#)["error"]["message"].as_str().unwrap().contains("unknown variant"));
//! ```

use uchain_libm as _; // the same bits on every system

mod answer;
mod flown;
mod library;
mod open;
mod problem;
mod seed;
mod seen;
mod told;
#[cfg(target_arch = "wasm32")]
mod wasm;

pub use answer::Engine;
