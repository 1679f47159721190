//! Help texts below the options, examples first: of the whole program, and of commands without a room.

/// Of the whole; the table of exit codes follows.
pub(super) const TOP: &str = "\
Examples:
  uchain list                                what is there to fly
  uchain run corner                          fly it; results in runs/corner-s1
  uchain view circuit                        fly it by hand, in the browser
  uchain run corner --seed 7 --set chain.uavs=5 --set radio.sigma_db=0
  uchain run apartment --set explore.robots=4   robots explore rooms together
  uchain run corner --set preset=cavemod     with the values of the authors' firmware
  uchain inspect runs/corner-s1/run.mcap     look into a recording
  uchain verify runs/corner-s1/run.mcap      fly it again: still the same, bit for bit?
  uchain sweep corner --vary radio.sigma_db=0,4 --replicates 20 --out sigma && uchain report sigma
  uchain plan corner                         how many UAVs does it need? (flies nothing)
  uchain radio fit walk.csv                  what radio is that? exponent, noise, shadowing
  uchain node log.csv                        what would the laws have asked for, in a real flight?
  uchain paper fig4e fig10 --out again       figures of the papers, published values beside ours
  uchain explain radio.alpha_wall            what is that, and what may it be?
  uchain show corner > mine.toml             copy a scenario and edit it
  uchain check mine.toml                     is it right? (flies nothing)
  uchain run ./mine.toml --out results/a --json | jq .spread_db

Results:
  stdout holds what was asked for, stderr progress and errors. Files go into runs/<scenario>-s<seed>,
  plans/<scenario>, nodes/<log> and fits/<log> below the folder you are in, or into --out; a file mine.toml goes by its own name, into
  runs/mine-s<seed>, and pages of uchain view into views. A folder tells of one run: what was there goes. Progress shows on a terminal only.

Environment:
  NO_COLOR=1, CLICOLOR=0   no colour in help and usage errors; there is none anyway but on a terminal
  CLICOLOR_FORCE=1         colour wherever it goes
  TERM=dumb                no colour and no progress
  UCHAIN_PAGE=FILE         the page that uchain view fills, in the place of its own
";

pub(super) const LIST: &str = "\
Examples:
  uchain list
  uchain list | grep circuit

Names without '=' are scenarios, for run, plan, show and check. The others are presets: write them
behind --set.
";

pub(super) const SHOW: &str = "\
Examples:
  uchain show corner
  uchain show corner > mine.toml             copy, edit, then: uchain check mine.toml
  uchain show --preset cavemod               values of a preset, each with its source
";

pub(super) const CHECK: &str = "\
Examples:
  uchain check mine.toml
  uchain check corner --set chain.uavs=9
  uchain check mine.toml --quiet && echo right

Exits with 0 if the scenario can be flown, with 3 and the place of the first mistake if not.
";

pub(super) const EXPLAIN: &str = "\
Examples:
  uchain explain                             all keys, one line each
  uchain explain radio                       the keys of one table
  uchain explain equalize.k_db_per_m         meaning, symbol, equation, unit, range, default, source
  uchain explain k_db_per_m                  the last part of the name will do, if only one key has it

Says as well what the presets and the built-in scenarios write there.
";

pub(super) const SCHEMA: &str = "\
Examples:
  uchain schema > uchain.schema.json         beside your scenario files

An editor that knows TOML schemas (Taplo; Even Better TOML in VS Code) reads it for every file whose
first line is
  #:schema ./uchain.schema.json
as in what `uchain show` prints: it then completes keys, shows what they mean and marks mistakes.
";

pub(super) const COMPLETIONS: &str = "\
Examples:
  source <(uchain completions bash)          for this shell; put the line into ~/.bashrc to keep it
  uchain completions zsh > ~/.zfunc/_uchain  a folder of your $fpath
  uchain completions fish > ~/.config/fish/completions/uchain.fish
";

pub(super) const MAN: &str = "\
Examples:
  uchain man | man -l -                      read it
  uchain man --out ~/.local/share/man/man1   then: man uchain, man uchain-run
";
