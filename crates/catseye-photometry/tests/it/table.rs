//! Tables are read as they are meant, and whatever is wrong with one is said with its place and the way out.

use std::time::{Duration, Instant};

use catseye_photometry::{Limit, Quantity, Table, Unit};
use proptest::prelude::*;

fn values(text: &str) -> Result<Table, String> {
    Table::parse_values(text.as_bytes(), "t.csv").map_err(|error| error.to_string())
}

#[test]
fn columns_come_in_any_order_and_unknown_ones_are_kept() {
    let text = "note,unit,value,entrance_deg,observation_deg\n\"a, b\",cd/lx/m2,250,-4,0.2\n";
    let table = values(text).unwrap();
    let row = &table.rows()[0];
    assert_eq!((row.observation_deg, row.entrance_deg, row.rotation_deg), (0.2, -4.0, 0.0));
    assert_eq!((row.quantity, row.value, row.line), (Quantity::RetroReflectionCoefficient, Some(250.0), 2));
    assert_eq!(table.to_csv(&[]), text);
    let with_model = table.to_csv(&[("model", vec!["251".to_owned()]), ("unit", vec!["x".to_owned()])]);
    assert_eq!(with_model, "note,value,entrance_deg,observation_deg,model,unit\n\"a, b\",250,-4,0.2,251,x\n");
}

#[test]
fn units_end_where_text_is_read() {
    let text = "observation_deg,entrance_deg,value,unit\n\
                1.05,88.76,150,mcd/lx/m2 (R_L)\n0.2,0,420,mcd/lx (CIL)\n0.2,30,8,cd/fc (CIL)\n45,45,27,%\n";
    let table = values(text).unwrap();
    let found: Vec<_> = table.rows().iter().map(|row| (row.quantity, row.value.unwrap())).collect();
    assert_eq!(found[0], (Quantity::RetroReflectedLuminance, 0.15));
    assert_eq!(found[1], (Quantity::LuminousIntensity, 0.42));
    assert_eq!(found[2].0, Quantity::LuminousIntensity);
    assert!((found[2].1 - 8.0 / 10.763_910_416_709_722).abs() < 1e-12);
    assert_eq!(found[3], (Quantity::LuminanceFactor, 0.27));
    assert_eq!(table.rows()[0].unit, Unit::MillicandelaPerLuxSquareMetre);
    assert_eq!(table.rows()[0].value_as_written(), Some(150.0));
}

#[test]
fn limits_come_from_their_column_or_from_the_standards_name() {
    let text = "standard,limit,observation_deg,entrance_deg,value,unit\n\
                X minimum,,0.2,5,50,cd/lx/m2\nX MAXIMUM,,0.2,5,250,cd/lx/m2\nX,maximum,0.2,5,200,cd/lx/m2\n\
                X,,0.2,5,100,cd/lx/m2\n";
    let limits: Vec<Limit> = values(text).unwrap().rows().iter().map(|row| row.limit).collect();
    assert_eq!(limits, [Limit::Minimum, Limit::Maximum, Limit::Maximum, Limit::Typical]);
}

#[test]
fn geometries_need_no_values() {
    let text = "observation_deg,entrance_deg,rotation_deg,value\n0,0,,n/a\n0.2,-4,90,-1\n";
    let table = Table::parse_geometries(text.as_bytes(), "t.csv").unwrap();
    assert_eq!(table.rows().len(), 2);
    assert_eq!(table.rows()[1].rotation_deg, 90.0);
    assert!(table.rows()[1].value.is_none());
}

#[test]
fn bad_tables_are_refused_with_their_place() {
    let head = "observation_deg,entrance_deg,value,unit";
    let cases: &[(&str, &str)] = &[
        // The whole table.
        ("", "t.csv: is empty; a header line and rows are needed"),
        ("\n \n", "t.csv: is empty; a header line and rows are needed"),
        (head, "t.csv: has a header, but no rows"),
        ("value,unit\n1,1\n", "t.csv: missing columns observation_deg, entrance_deg"),
        ("observation_deg,entrance_deg,unit\n0.2,5,1\n", "t.csv: missing column value"),
        ("value,entrance_deg,value\n", "t.csv: column \"value\" appears twice"),
        // A row.
        ("H\n0.2,5,1\n", "t.csv:2: 3 fields, but the header has 4"),
        ("H\n\n\n0.2,5,70,cd/lx/m2,x\n", "t.csv:4: 5 fields, but the header has 4"),
        (
            "H\n20,-80,70,cd/lx/m2\n",
            "t.csv:2: at observation angle 20 and entrance angle -80 the receiver is below",
        ),
        (
            "H\n0.2,5,70,cd/lx/m2\n0.5,5,30,cd/lx/m2\n0.2,5,80,cd/lx/m2\n",
            "t.csv:4: says R_A = 80 cd/lx/m2, but line 2 says 70 cd/lx/m2 at the same angles; keep one",
        ),
        // A cell.
        ("H\n0.2,5,-70,cd/lx/m2\n", "t.csv:2: column value: -70 is negative"),
        ("H\n0.2,5,NaN,cd/lx/m2\n", "t.csv:2: column value: \"NaN\" is not a number"),
        ("H\n0.2,5,inf,cd/lx/m2\n", "t.csv:2: column value: \"inf\" is not a number"),
        ("H\n0.2,5,,cd/lx/m2\n", "t.csv:2: column value: is empty"),
        ("H\n0.2,5,0,cd/lx/m2\n", "t.csv:2: column value: is 0; leave the row out"),
        (
            "H\n0.2,5,\"7,500\",cd/lx/m2\n",
            "t.csv:2: column value: \"7,500\" could have a sign between thousands",
        ),
        ("H\n0.2,,70,cd/lx/m2\n", "t.csv:2: column entrance_deg: is empty"),
        ("H\n0.2,90,70,cd/lx/m2\n", "t.csv:2: column entrance_deg: 90 is outside (-90, 90)"),
        ("H\n-0.2,5,70,cd/lx/m2\n", "t.csv:2: column observation_deg: -0.2 is outside [0, 180)"),
        ("H\n0,5,70,cd/lx/m2\n", "t.csv:2: column observation_deg: is 0, where source and receiver coincide"),
        ("H\n0.2,5,70,cd\n", "t.csv:2: column unit: \"cd\" is not a known unit; known are cd/lx/m2, "),
        ("H\n0.2,5,250000,mcd/lx/m2\n", "t.csv:2: column unit: mcd/lx/m2 is the unit of road markings"),
        (
            "H\n0.2,5,250000,cd/lx/m2\n",
            "is not plausible: 0.000001 to 50000 cd/lx/m2 are; is mcd/lx/m2 meant?",
        ),
        (
            "H\n0.2,5,3e-7,cd/lx/m2\n",
            "is not plausible: 0.000001 to 50000 cd/lx/m2 are; check the value and its unit",
        ),
        (
            "H\n1.05,88.76,150,cd/lx/m2 (R_L)\n",
            "column value: R_L = 150 cd/lx/m2 is not plausible: 0.0001 to 20",
        ),
        ("H\n45,45,27,1\n", "Y = 27 is not plausible: 0.001 to 2 are; is % meant?"),
        (
            "observation_deg,entrance_deg,value,unit,quantity\n0.2,5,70,cd/lx/m2,R_I\n",
            "t.csv:2: column unit: cd/lx/m2 is no unit of R_I, which is given in cd/lx",
        ),
        (
            "observation_deg,entrance_deg,value,unit,quantity\n0.2,5,70,cd/lx/m2,SIR\n",
            "t.csv:2: column quantity: \"SIR\" is not a quantity; known are R_A, ",
        ),
        (
            "observation_deg,entrance_deg,value,unit,limit\n0.2,5,70,cd/lx/m2,about\n",
            "t.csv:2: column limit: \"about\" is not minimum, maximum or typical",
        ),
        (
            "observation_deg,entrance_deg,value,unit,rotation_deg\n0.2,5,70,cd/lx/m2,400\n",
            "t.csv:2: column rotation_deg: 400 is outside [-360, 360]",
        ),
    ];
    for (text, expected) in cases {
        let text = text.replacen("H\n", &format!("{head}\n"), 1);
        let error = values(&text).expect_err(&text);
        assert!(error.contains(expected), "{text:?}\n gave   {error}\n wanted {expected}");
    }
}

#[test]
fn what_is_no_text_is_refused() {
    let mut bytes = b"observation_deg,entrance_deg,value,unit\n0.2,5,70,cd/lx/m2\n0.2,\xff".to_vec();
    let error = Table::parse_values(&bytes, "t.csv").unwrap_err().to_string();
    assert!(error.starts_with("t.csv:3: is not UTF-8"), "{error}");
    bytes.resize(17 << 20, b'x');
    let error = Table::parse_values(&bytes, "t.csv").unwrap_err().to_string();
    assert!(error.starts_with("t.csv: is larger than 16 MiB"), "{error}");
}

#[test]
fn lines_are_counted_through_crlf_byte_order_mark_and_quoted_line_ends() {
    let text = "\u{feff}observation_deg,entrance_deg,value,unit,source\r\n\
                0.2,5,70,cd/lx/m2,\"a\r\nb\"\r\n\r\n0.2,30,0,cd/lx/m2,c\r\n";
    let error = values(text).unwrap_err();
    assert!(error.starts_with("t.csv:5: column value: is 0"), "{error}");
}

#[test]
fn a_table_is_read_in_the_time_of_its_length() {
    let table = |rows: usize| {
        let mut text = "observation_deg,entrance_deg,value,unit\n".to_owned();
        for row in 0..rows {
            text += &format!("{},{},100,cd/lx/m2\n", 0.1 + 1e-4 * row as f64, -4);
        }
        text
    };
    // Where each row's line was counted from the start, this took minutes.
    let (text, start) = (table(100_000), Instant::now());
    let read = values(&text).unwrap();
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
    assert_eq!(read.rows()[99_999].line, 100_001);
}

proptest! {
    #[test]
    fn no_text_makes_the_reader_panic(cells in proptest::collection::vec("[-0-9.eEinfaN%,\"cd/lxmr2R_A \n]{0,8}", 0..12)) {
        let header = "observation_deg,entrance_deg,value,unit\n";
        for parse in [Table::parse_geometries, Table::parse_values] {
            parse(cells.join(",").as_bytes(), "t").ok();
            if let Ok(table) = parse((header.to_owned() + &cells.join(",")).as_bytes(), "t") {
                for row in table.rows() {
                    prop_assert!(row.geometry().is_above_horizon());
                    prop_assert!(row.value.is_none_or(|value| value > 0.0 && value.is_finite()));
                }
            }
        }
    }

    #[test]
    fn what_is_written_is_read_again(
        rows in proptest::collection::vec((0.05_f64..60.0, -29.0_f64..89.0, 0.02_f64..4e4, "[a-z ,\"]{0,9}"), 1..9),
    ) {
        let mut text = "observation_deg,entrance_deg,value,unit,class\n".to_owned();
        for (i, (observation, entrance, value, class)) in rows.iter().enumerate() {
            let class = class.replace('"', "\"\"");
            text += &format!("{observation},{entrance},{value},cd/lx/m2 (R_A),\"{i}{class}\"\n");
        }
        let Ok(table) = Table::parse_values(text.as_bytes(), "t") else { return Ok(()) };
        let again = Table::parse_values(table.to_csv(&[]).as_bytes(), "t").unwrap();
        prop_assert_eq!(&table, &again);
    }
}
