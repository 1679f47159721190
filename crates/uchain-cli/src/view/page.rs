//! The page that flights are put into: built by `cargo xtask web`, inside this program if it was built with the feature
//! `view`.

use std::{
    borrow::Cow,
    env, fs,
    path::{Path, PathBuf},
};

use crate::exit::Failure;

/// Where a flight goes.
const PLACE: &str = "<!-- uchain:flight -->";
/// Says where the page is.
const PAGE: &str = "UCHAIN_PAGE";

#[cfg(feature = "view")]
const INSIDE: Option<&str> = Some(include_str!(env!("UCHAIN_PAGE_INSIDE")));
#[cfg(not(feature = "view"))]
const INSIDE: Option<&str> = None;

/// The page with a flight in it, which is JSON without any `<`; or the page alone.
pub(super) fn with(flight: Option<&str>) -> Result<String, Failure> {
    let page = find()?;
    let Some((before, after)) = page.split_once(PLACE) else {
        return Err(Failure::Map(format!("the page has no place for a flight: expected {PLACE} in it")));
    };
    let Some(flight) = flight else { return Ok(page.into_owned()) };
    Ok([before, "<script type=\"application/json\" id=\"flight\">", flight, "</script>", after].concat())
}

/// The page that the user names, that is inside, or that was built beside this program.
fn find() -> Result<Cow<'static, str>, Failure> {
    if let Some(named) = env::var_os(PAGE) {
        let file = PathBuf::from(named);
        return fs::read_to_string(&file)
            .map(Cow::Owned)
            .map_err(|cause| Failure::Map(format!("{PAGE}={}: {cause}", file.display())));
    }
    if let Some(page) = INSIDE {
        return Ok(Cow::Borrowed(page));
    }
    let beside = env::current_exe().ok().and_then(|program| beside(&program));
    beside.map(Cow::Owned).ok_or(Failure::NoPage)
}

/// What `cargo xtask web` leaves in the target folder, where cargo puts programs as well: `target/release/uchain`, or
/// `target/TARGET/release/uchain`.
fn beside(program: &Path) -> Option<String> {
    let above = program.ancestors().skip(2).take(2);
    above.map(|folder| folder.join("web/uchain.html")).find_map(|page| fs::read_to_string(page).ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_finds_the_page_in_its_target_folder_and_nowhere_else() {
        let target = tempfile::tempdir().unwrap();
        let program = |path: &str| beside(&target.path().join(path));
        assert_eq!(program("release/uchain"), None);
        fs::create_dir(target.path().join("web")).unwrap();
        fs::write(target.path().join("web/uchain.html"), "page").unwrap();
        assert_eq!(program("release/uchain").as_deref(), Some("page"));
        assert_eq!(program("x86_64-unknown-linux-gnu/release/uchain").as_deref(), Some("page"));
        assert_eq!(program("home/of/some/bin/uchain"), None);
    }
}
