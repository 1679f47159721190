//! The page in a real browser: built, opened from disk, flown, and compared with the command line.

use std::{
    env,
    path::{Path, PathBuf},
    process::Command,
};

use anyhow::{Result, bail};

use super::environment::Environment;
use crate::{
    house::{self, House, must_fail_with, run},
    steps::Outcome,
    web::{self, Effort},
};

/// Browsers that playwright drives, by the names of their programs.
const BROWSERS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];
/// Names another one.
const BROWSER: &str = "UCHAIN_BROWSER";

pub(crate) fn flies_in_a_browser(house: &House) -> Result<Outcome> {
    if let Err(why) = web::is_ready()? {
        return missing(why);
    }
    let page = web::build(house, Effort::Quick)?;
    takes_the_page_along(house, &page)?;

    let Some(browser) = browser() else {
        let names = BROWSERS.join(", ");
        return missing(format!(
            "THE PAGE WAS NOT TESTED: no browser here ({names}); apt-get install chromium, or {BROWSER}=PROGRAM"
        ));
    };
    let environment = match Environment::of(house, "tests/web/requirements.txt", "python-web")? {
        Ok(environment) => environment,
        Err(why) => return Ok(Outcome::Skipped(why)),
    };
    // Words of the step `test`: whole workspace, same features, so that nothing compiles a second time.
    run(&mut house.cargo("test --locked --profile checked --workspace --tests --no-run"))?;
    run(Command::new(environment.python())
        .args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider", "tests/web"])
        .current_dir(&house.root)
        .env("UCHAIN_CLI", house.target.join("checked/uchain"))
        .env("UCHAIN_PAGE", page)
        .env("UCHAIN_SCREENSHOTS", house.target.join("web/screenshots"))
        .env(BROWSER, browser))?;
    Ok(Outcome::Passed)
}

/// What is missing, which is an error when `CI=true`.
fn missing(why: String) -> Result<Outcome> {
    if house::ci() {
        bail!(why);
    }
    Ok(Outcome::Skipped(why))
}

/// The feature `view` has the page inside, and says in a line what to do where there is none.
fn takes_the_page_along(house: &House, page: &Path) -> Result<()> {
    // Words of the step `clippy`, so that nothing but the command line is looked at a second time.
    let clippy = "clippy --locked --profile checked --workspace --all-targets --features uchain-cli/view -- -D warnings";
    run(house.cargo(clippy).env("UCHAIN_PAGE", page))?;
    let nowhere = page.with_file_name("nowhere.html");
    must_fail_with(house.cargo(clippy).env("UCHAIN_PAGE", nowhere), "run `cargo xtask web` first")
}

/// The browser that is named, or the first one that is there.
fn browser() -> Option<PathBuf> {
    if let Some(named) = env::var_os(BROWSER) {
        return Some(named.into());
    }
    let folders: Vec<PathBuf> = env::var_os("PATH").iter().flat_map(env::split_paths).collect();
    let places = BROWSERS.iter().flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    places.into_iter().find(|program| program.is_file())
}
