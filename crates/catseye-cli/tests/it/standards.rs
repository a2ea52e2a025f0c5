//! `catseye standards` lists every class with its source, and what it shows is measured as the standard.

use crate::run::Bench;
use crate::sheeting::bench;

#[test]
fn every_class_is_listed_with_its_source() {
    let outcome = Bench::new().catseye("standards", "");
    assert_eq!(outcome.stdout, Bench::new().catseye("standards list", "").stdout);
    for id in
        ["fmvss108:dot-c4:red", "16cfr1512:bicycle:clear", "en1436:r5:white", "3m:8765:white", "3m:dg3:white"]
    {
        assert!(outcome.stdout.contains(&format!("  {id} ")), "{id}");
    }
    let json = Bench::new().catseye("standards list --json", "").stdout;
    let classes: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(classes.as_array().unwrap().len(), 90);
    assert_eq!(classes[0]["id"], "astm-d4956:i:white");
    assert!(!classes[0]["sources"][0].as_str().unwrap().is_empty());
    let rows = Bench::new().catseye("standards show en1436:r3 --json", "").stdout;
    let rows: serde_json::Value = serde_json::from_str(&rows).unwrap();
    assert_eq!((rows[0]["value"].as_f64(), rows[0]["unit"].as_str()), (Some(150.0), Some("mcd/lx/m2")));
}

#[test]
fn what_standards_show_prints_is_measured_like_the_standard() {
    let bench = bench();
    let shown = bench.catseye("standards show iso20471", "").stdout;
    bench.write("own.csv", &shown);
    let own = bench.catseye("measure m.mtlx --standard own.csv", "").stdout;
    assert_eq!(own, bench.catseye("measure m.mtlx --standard iso20471", "").stdout);
    assert_eq!(own, bench.catseye("measure m.mtlx --geometry own.csv", "").stdout);
    assert_eq!(own.lines().count(), 17);
}
