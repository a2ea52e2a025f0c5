//! Promise: every value that comes with the crate has a source, and a class is found by any name that means
//! it.

use catseye_photometry::Row;
use catseye_photometry::standards::{Catalogue, StandardClass};

fn found(name: &str) -> String {
    match Catalogue::embedded().unwrap().find(name) {
        Ok(class) => class.id().to_owned(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn every_row_is_sound_and_has_a_source() {
    let catalogue = Catalogue::embedded().unwrap();
    let rows: Vec<&Row> = catalogue.classes().iter().flat_map(StandardClass::rows).collect();
    assert_eq!(rows.len(), 509, "the rows that were read in standards and data sheets");
    for row in rows {
        assert!(!row.source.is_empty() && row.value.is_some(), "{row:?}");
    }
    for class in catalogue.classes() {
        assert_eq!(found(class.id()), class.id(), "an id names its class and no other");
    }
}

#[test]
fn names_need_neither_case_nor_signs_nor_all_of_their_letters() {
    let cases = [
        ("FMVSS108:DOT-C2:White", "fmvss108:dot-c2:white"),
        ("fmvss 108:Grade DOT-C2:white", "fmvss108:dot-c2:white"),
        ("astm-d4956:i:white", "astm-d4956:i:white"),
        ("d4956:Type II:white", "astm-d4956:ii:white"),
        ("iso20471", "iso20471:separate:white"),
        ("ISO 20471", "iso20471:separate:white"),
        ("16 CFR 1512", "16cfr1512:bicycle:clear"),
        ("en1436:r3", "en1436:r3:white"),
        ("fra-224:white", "fra-224:rail:white"),
        ("fr-plate:blue", "fr-plate:sheeting:blue"),
        ("3m-8830", "3m:8830:white"),
        ("3M:DG3:white", "3m:dg3:white"),
        ("StVZVO:Typ 2:grey", "at-stvzvo:typ-2:grey"),
        ("it-dpr495:white", "it-dpr495:triangle:white"),
        ("ansi-107:level-2", "ansi-107:level-2:white"),
    ];
    for (name, id) in cases {
        assert_eq!(found(name), id, "{name}");
    }
}

#[test]
fn what_is_not_one_class_is_told_the_candidates() {
    assert!(found("fmvss108:dot-c2").contains("fmvss108:dot-c2:white, fmvss108:dot-c2:red"));
    assert!(found("fmvss108:dot-c5:white").contains("fmvss108:dot-c2:white"));
    let types = "astm-d4956:i, astm-d4956:ii, astm-d4956:iii; say which one";
    assert!(found("d4956").contains(types), "{}", found("d4956"));
    for name in ["", "x", "fmvss108:dot-c2:white:new"] {
        assert!(found(name).contains("astm-d4956, fdot-994, fmvss108"), "{}", found(name));
    }
}

#[test]
fn a_class_from_two_sources_is_one_table() {
    let catalogue = Catalogue::embedded().unwrap();
    let class = catalogue.find("astm-d4956:iii:white").unwrap();
    assert_eq!(class.rows().len(), 6);
    assert_eq!(class.title(), "ASTM D4956 Type III white");
    let sources: std::collections::HashSet<&str> =
        class.rows().iter().map(|row| row.source.as_str()).collect();
    assert_eq!(sources.len(), 2);
}
