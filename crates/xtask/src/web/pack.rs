//! Packs the page into one file: style, modules and engine inside, nothing asked of any server.
//!
//! Modules of JavaScript cannot import each other from `file://`. So they are packed together, and when the page opens each
//! becomes a `data:` address, and one import map says which name is which: `import {app} from "uchain/app.js"`. The map has
//! to be there before the first module is asked for, so that what unpacks it is no module itself.

use std::{
    fs,
    io::Write as _,
    path::{Path, PathBuf},
};

use anyhow::{Context as _, Result, ensure};
use base64::{Engine as _, prelude::BASE64_STANDARD};
use flate2::{Compression, write::GzEncoder};

/// What stays in the page, for `uchain view` to put a flight there.
const FLIGHT: &str = "<!-- uchain:flight -->";
/// What starts it.
const ENTRY: &str = "<script type=\"module\">import \"uchain/main.js\"</script>";
/// What does so in the page.
const UNPACK: &str = r#"<script>
(async () => {
  const packed = Uint8Array.from(atob(document.getElementById("modules").textContent), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  const imports = await new Response(stream).json();
  for (const name in imports) imports[name] = "data:text/javascript;charset=utf-8," + encodeURIComponent(imports[name]);
  const map = document.createElement("script");
  map.type = "importmap";
  map.textContent = JSON.stringify({ imports });
  document.head.append(map);
  await import("uchain/main.js");
})();
</script>"#;
/// Names in XML look like addresses, and nothing is fetched from them.
const XML_NAMES: &str = "http://www.w3.org/";

/// A file of the page.
struct Source {
    /// Its path below the folder, with `/`.
    name: String,
    text: String,
}

/// Bytes as gzip, the same for the same bytes.
pub(super) fn gzip(bytes: &[u8]) -> Result<Vec<u8>> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes).and_then(|()| encoder.finish()).context("cannot compress the engine")
}

/// The same, as small as it gets.
pub(super) fn gzip_small(bytes: &[u8]) -> Result<Vec<u8>> {
    let mut zipped = Vec::new();
    zopfli::compress(zopfli::Options::default(), zopfli::Format::Gzip, bytes, &mut zipped)
        .context("cannot compress the engine")?;
    Ok(zipped)
}

/// The whole page: what is in a folder, and the engine in gzip.
pub(super) fn page(folder: &Path, engine: &[u8]) -> Result<String> {
    let files = sources(folder)?;
    for file in &files {
        asks_nobody(file)?;
    }
    let ending = |end: &'static str| files.iter().filter(move |file| file.name.ends_with(end));
    let index = files.iter().find(|file| file.name == "index.html").context("index.html is missing")?;

    let style: String = ending(".css").map(|file| file.text.as_str()).collect();
    ensure!(!style.contains("</"), "a style sheet holds `</`, which would end it");
    let modules: Vec<&Source> = ending(".js").collect();
    for module in &modules {
        imports_what_is_there(module, &modules)?;
    }
    imports_what_is_there(index, &modules)?;
    ensure!(index.text.contains(ENTRY), "index.html does not start the page: expected {ENTRY}");
    let texts: serde_json::Map<String, serde_json::Value> =
        modules.iter().map(|module| named(module)).collect();
    let texts = gzip(&serde_json::to_vec(&texts)?)?;

    let parts = [
        ("<!-- uchain:style -->", format!("<style>\n{style}</style>")),
        ("<!-- uchain:modules -->", bytes("modules", &texts)),
        ("<!-- uchain:engine -->", bytes("engine", engine)),
        (ENTRY, UNPACK.to_owned()),
        (FLIGHT, FLIGHT.to_owned()),
    ];
    let mut page = index.text.clone();
    for (marker, part) in parts {
        let count = index.text.matches(marker).count();
        ensure!(count == 1, "index.html holds `{marker}` {count} times: expected once");
        page = page.replace(marker, &part);
    }
    Ok(page)
}

/// All files of the page, in the order of their names.
fn sources(folder: &Path) -> Result<Vec<Source>> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        let entries = fs::read_dir(&next).with_context(|| format!("cannot read {}", next.display()))?;
        let paths: Vec<PathBuf> = entries.map(|entry| Ok(entry?.path())).collect::<Result<_>>()?;
        for path in paths {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "html" || end == "css" || end == "js") {
                let steps = path.strip_prefix(folder)?.iter().map(|step| step.to_string_lossy());
                let name = steps.collect::<Vec<_>>().join("/");
                let is_plain = |c: char| c.is_ascii_alphanumeric() || "._-/".contains(c);
                ensure!(name.chars().all(is_plain), "{name}: expected a name of letters, digits, . _ and -");
                let text = fs::read_to_string(&path).with_context(|| format!("cannot read {name}"))?;
                files.push(Source { name, text });
            }
        }
    }
    files.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(files)
}

/// Bytes in the page.
fn bytes(id: &str, bytes: &[u8]) -> String {
    let text = BASE64_STANDARD.encode(bytes);
    format!("<script type=\"application/octet-stream\" id=\"{id}\">{text}</script>")
}

/// A module by the name it is imported by. The name at its end is what a browser calls it in its messages.
fn named(module: &Source) -> (String, serde_json::Value) {
    let name = format!("uchain/{}", module.name);
    let text = format!("{}\n//# sourceURL={name}\n", module.text);
    (name, text.into())
}

/// The page has all it needs inside.
fn asks_nobody(file: &Source) -> Result<()> {
    for (number, line) in file.text.lines().enumerate() {
        let rest = line.replace(XML_NAMES, "");
        let asks = ["http://", "https://"].into_iter().any(|start| rest.contains(start));
        ensure!(!asks, "{}, line {}: the page must ask no server: {}", file.name, number + 1, line.trim());
    }
    Ok(())
}

/// A name that nobody has would be a dead page.
fn imports_what_is_there(module: &Source, all: &[&Source]) -> Result<()> {
    for (number, line) in module.text.lines().enumerate() {
        let place = || format!("{}, line {}", module.name, number + 1);
        for quote in ['"', '\''] {
            let start = format!("{quote}uchain/");
            let named = line.split(&start).skip(1);
            for name in named.filter_map(|rest| rest.split(quote).next()) {
                let is_there = all.iter().any(|other| other.name == name);
                ensure!(is_there, "{}: there is no module uchain/{name}", place());
            }
            let is_relative =
                [" from ", "import "].iter().any(|word| line.contains(&format!("{word}{quote}.")));
            ensure!(!is_relative, "{}: modules import each other by name, as in \"uchain/app.js\"", place());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::io::Read as _;

    use flate2::read::GzDecoder;

    use super::*;

    const INDEX: &str = "<!doctype html>\n<!-- uchain:style -->\n<main></main>\n<!-- uchain:flight -->\n\
                         <!-- uchain:engine -->\n<!-- uchain:modules -->\n\
                         <script type=\"module\">import \"uchain/main.js\"</script>\n";
    const SOUND: [(&str, &str); 5] = [
        ("index.html", INDEX),
        ("style.css", "main { color: #222222 }\n"),
        ("main.js", "import {draw} from \"uchain/map/draw.js\";\ndraw();\n"),
        ("map/draw.js", "export const draw = () => \"http://www.w3.org/2000/svg\";\n"),
        ("notes.txt", "no part of the page: https://example.org\n"),
    ];

    /// The page of some files, the last of those with the same name.
    fn packed(files: &[(&str, &str)]) -> Result<String> {
        let folder = tempfile::tempdir()?;
        for (name, text) in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap())?;
            fs::write(path, text)?;
        }
        page(folder.path(), b"the engine")
    }

    fn refused(name: &str, text: &str) -> String {
        packed(&[&SOUND[..], &[(name, text)]].concat()).unwrap_err().to_string()
    }

    #[test]
    fn everything_is_in_one_file_and_the_place_for_a_flight_stays() {
        let page = packed(&SOUND).unwrap();
        assert!(page.starts_with("<!doctype html>\n<style>\nmain { color: #222222 }\n</style>"), "{page}");
        assert_eq!(page.matches("<!-- uchain:").count(), 1, "{page}");
        assert_eq!(page.matches(FLIGHT).count(), 1);
        let engine = page.split("id=\"engine\">").nth(1).unwrap().split('<').next().unwrap();
        assert_eq!(BASE64_STANDARD.decode(engine).unwrap(), b"the engine");
        let packed = page.split("id=\"modules\">").nth(1).unwrap().split('<').next().unwrap();
        let mut texts = String::new();
        let packed = BASE64_STANDARD.decode(packed).unwrap();
        GzDecoder::new(packed.as_slice()).read_to_string(&mut texts).unwrap();
        let texts: serde_json::Value = serde_json::from_str(&texts).unwrap();
        let text = texts["uchain/map/draw.js"].as_str().unwrap();
        assert!(
            text.starts_with("export const draw") && text.ends_with("//# sourceURL=uchain/map/draw.js\n")
        );
        assert_eq!(texts.as_object().unwrap().len(), 2);
        assert!(page.ends_with("</script>\n") && page.contains("await import(\"uchain/main.js\")"));
    }

    #[test]
    fn the_same_sources_are_the_same_page_and_the_engine_comes_out_as_it_went_in() {
        assert_eq!(packed(&SOUND).unwrap(), packed(&SOUND).unwrap());
        let bytes: Vec<u8> = (0..30_000_u32).map(|i| ((i * i) >> 7) as u8).collect();
        for gzip in [gzip, gzip_small] {
            let zipped = gzip(&bytes).unwrap();
            assert_eq!(zipped, gzip(&bytes).unwrap());
            let mut back = Vec::new();
            GzDecoder::new(zipped.as_slice()).read_to_end(&mut back).unwrap();
            assert_eq!(back, bytes);
        }
    }

    #[test]
    fn a_page_that_would_ask_a_server_is_refused_with_its_line() {
        let said = refused("style.css", "main {}\n@import \"https://example.org/font.css\";\n");
        assert!(said.contains("style.css, line 2"), "{said}");
        assert!(refused("main.js", "fetch(\"http://localhost\")").contains("main.js, line 1"));
        assert!(
            refused("index.html", &(INDEX.to_owned() + "<img src=https://x.org/a.png>")).contains("line 8")
        );
    }

    #[test]
    fn a_page_that_would_be_dead_is_refused() {
        let said = refused("map/draw.js", "import {x} from \"uchain/map/darw.js\";\n");
        assert!(said.contains("map/draw.js, line 1: there is no module uchain/map/darw.js"), "{said}");
        assert!(refused("main.js", "import './map/draw.js'\n").contains("by name"));
        assert!(refused("main.js", "export {x} from \"../x.js\"\n").contains("by name"));
        let twice = INDEX.to_owned() + "<!-- uchain:engine -->";
        assert!(refused("index.html", &twice).contains("`<!-- uchain:engine -->` 2 times"));
        assert!(refused("index.html", ENTRY).contains("`<!-- uchain:style -->` 0 times"));
        assert!(refused("style.css", "</style>").contains("would end it"));
        assert!(refused("odd name.js", "").contains("odd name.js"));
        assert!(packed(&SOUND[..2]).unwrap_err().to_string().contains("no module uchain/main.js"));
        let idle = INDEX.replace("import \"uchain/main.js\"", "");
        assert!(refused("index.html", &idle).contains("does not start"));
        assert!(packed(&SOUND[1..]).unwrap_err().to_string().contains("index.html is missing"));
    }
}
