//! The table and what is read by it.

use std::path::Path;

use super::*;

#[test]
fn a_scenario_names_the_kinds_by_the_words_of_the_table_and_no_others() {
    let error = toml::from_str::<MapConfig>("[nonsense]\n").unwrap_err().to_string();
    let words: Vec<String> = FORMATS.iter().map(|format| format!("`{}`", format.word())).collect();
    assert!(error.contains(&format!("expected one of {}", words.join(", "))), "{error}");
    for format in FORMATS {
        assert!(format.table.starts_with("map.") && !format.keys.is_empty(), "{format:?}");
        let read = toml::from_str::<MapConfig>(&format!("[{}]\n", format.word())).unwrap_err().to_string();
        let first = format.keys[0].name;
        assert!(read.contains(&format!("missing field `{first}`")), "{}: {read}", format.table);
    }
}

#[test]
fn a_file_is_of_one_kind_by_its_name_and_its_path_goes_to_the_key_file() {
    for format in FORMATS {
        let is_a_file = format.keys.iter().any(|key| key.name == "file");
        assert_eq!(is_a_file, !format.ends.is_empty(), "{}", format.table);
        for end in format.ends {
            let kind = |name: String| kind_of_map(Path::new(&name));
            assert_eq!(kind(format!("a/b.{end}")), Some(format.word()), "claimed by another kind");
            assert_eq!(kind(format!("b.{}", end.to_uppercase())), Some(format.word()));
            assert_eq!(kind(format!("b{end}")), None, "the control");
        }
    }
    assert_eq!(tables("`").matches("`[map.").count(), FORMATS.len());
    assert!(tables("").contains("[map.walls], [map.movingai]") && tables("").contains(" and [map."));
}

#[test]
fn what_is_laid_out_is_what_the_table_of_its_row_says() {
    let text = "[walls]\nouter_m = [[0, 0], [2, 0], [2, 2], [0, 2]]\n";
    let config: MapConfig = toml::from_str(text).unwrap();
    assert_eq!(config.format().table, "map.walls");
    let (map, line) = config.lay("".as_ref(), [0.0; 2]).unwrap();
    assert!(map.walls().len() == 4 && line.is_none());
    let text = "[corridor]\ncentre_line_m = [[0, 0], [9, 0]]\nwidth_m = 1\n";
    let config: MapConfig = toml::from_str(text).unwrap();
    assert!(config.lay("".as_ref(), [0.0; 2]).unwrap().1.is_some(), "a corridor knows its middle");
}

#[test]
fn what_a_file_holds_tells_its_kind_whatever_it_is_called() {
    let folder = tempfile::tempdir().unwrap();
    let kind = |name: &str, bytes: &[u8]| {
        let file = folder.path().join(name);
        std::fs::write(&file, bytes).unwrap();
        kind_of_map(&file)
    };
    let grid = b"type octile\nheight 1\nwidth 1\nmap\n.\n";
    assert_eq!(kind("grid.txt", grid), Some("movingai"));
    assert_eq!(kind("grid.png", grid), Some("movingai"), "the content counts more than the name");
    assert_eq!(kind("walls", b"\xef\xbb\xbfloop,x_m,y_m\n0,0,0\n"), Some("csv"), "a byte order mark is none");
    assert_eq!(kind("picture", b"P5\n1 1\n255\n\0"), Some("ros"));
    assert_eq!(kind("map.txt", b"resolution: 0.05\nimage: a.pgm\n"), Some("ros"));
    assert_eq!(
        kind("broken.yaml", b"rubbish"),
        Some("ros"),
        "the name counts where the content says nothing"
    );
    assert_eq!(kind("notes.txt", b"rubbish"), None);
    assert_eq!(kind("mine.toml", grid), None, "the control: a scenario");
    assert_eq!(kind_of_map(&folder.path().join("absent.map")), Some("movingai"));
    assert!(
        map_files().contains("MovingAI grid (.map), ROS map (.yaml, .yml, .pgm, .png)"),
        "{}",
        map_files()
    );
}
