use catseye_photometry::{
    Need, Table,
    fit::{Aim, FitOptions, Observation, fit},
};
#[test]
fn try_all() {
    let bytes = std::fs::read("/work/shared/oracle/photometry_tables.csv").unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let kept: String = text
        .lines()
        .enumerate()
        .filter(|(i, l)| *i == 0 || (l.contains("cd/lx/m2") && !l.contains("R_L") && !l.contains("MAXIMUM")))
        .map(|(_, l)| format!("{l}\n"))
        .collect();
    let table = Table::parse(kept.as_bytes(), "t", Need::Values).unwrap();
    let mut groups: Vec<((String, String, String), Vec<Observation>)> = vec![];
    for row in table.rows() {
        let key = (
            row.standard.replace("D4956 minimum (revision not stated)", "D4956-01 minimum"),
            row.class.clone(),
            row.colour.clone(),
        );
        let o = Observation::from_row(row, Aim::Equal, None).unwrap();
        match groups.iter_mut().find(|(k, _)| *k == key) {
            Some((_, v)) => v.push(o),
            None => groups.push((key, vec![o])),
        }
    }
    for (key, obs) in groups {
        let t = std::time::Instant::now();
        for model in [catseye::Model::Reciprocal, catseye::Model::BackVector] {
            match fit(&obs, &FitOptions { model, ..Default::default() }) {
                Ok(f) => {
                    println!(
                        "{key:?} {} {model:?} {:?} {:?} {:?} shared {} worst {:.1}% acceptable {} trials {} {:?}",
                        obs.len(),
                        f.form.lobes,
                        f.form.entrance,
                        f.estimates.len(),
                        f.form.shared,
                        100.0 * f.worst,
                        f.acceptable,
                        f.trials.len(),
                        t.elapsed()
                    );
                    if !f.acceptable {
                        println!("{:?}\n{:?}", f.sheeting, f.shape);
                    }
                }
                Err(e) => println!("{key:?} {e}"),
            }
        }
    }
}
