//! Data sheets as they come: the same six values in the forms of spreadsheets and laboratories are one table,
//! and what can't be read is refused with its place and the way out.

use catseye_photometry::{Limit, Quantity, Table, Unit};

/// Observation and entrance in degrees, `R_A` in cd/lx/m2.
const VALUES: [[&str; 3]; 6] = [
    ["0.2", "-4", "380.5"],
    ["0.2", "30", "215"],
    ["0.5", "-4", "135"],
    ["0.5", "30", "75.25"],
    ["1.5", "-4", "7"],
    ["1.5", "30", "0.004"],
];

/// How a sheet is written.
#[derive(Clone, Copy)]
struct Style {
    before: &'static str,
    header: &'static str,
    /// Between columns, and between lines.
    separator: &'static str,
    end: &'static str,
    /// The cells of a row after its values.
    after: &'static str,
    comma: bool,
    minutes: bool,
    degree_sign: bool,
}

const PLAIN: Style = Style {
    before: "",
    header: "observation_deg,entrance_deg,value,unit",
    separator: ",",
    end: "\n",
    after: "cd/lx/m2",
    comma: false,
    minutes: false,
    degree_sign: false,
};
/// A German spreadsheet.
const GERMAN: Style = Style {
    header: "observation_deg;entrance_deg;value;unit",
    separator: ";",
    end: "\r\n",
    comma: true,
    ..PLAIN
};

impl Style {
    fn text(&self) -> String {
        let mut text = format!("{}{}{}", self.before, self.header, self.end);
        for [observation, entrance, value] in VALUES {
            let minutes = observation.parse::<f64>().unwrap() * 60.0;
            let minutes = format!("{minutes:.0}");
            let mut angles =
                [if self.minutes { &minutes } else { observation }.to_owned(), entrance.to_owned()];
            if self.degree_sign {
                angles = angles.map(|angle| angle + "°");
            }
            let [observation, entrance] = angles;
            let mut cells = vec![observation, entrance, value.to_owned()];
            if self.comma {
                cells.iter_mut().for_each(|cell| *cell = cell.replace('.', ","));
            }
            if !self.after.is_empty() {
                cells.push(self.after.to_owned());
            }
            text += &format!("{}{}", cells.join(self.separator), self.end);
        }
        text
    }
}

fn check(text: &[u8], name: &str) {
    let table = Table::parse_values(text, "t.csv").unwrap_or_else(|error| panic!("{name}: {error}"));
    assert_eq!(table.rows().len(), VALUES.len(), "{name}");
    for (row, [observation, entrance, value]) in table.rows().iter().zip(VALUES) {
        let found = [row.observation_deg, row.entrance_deg, row.value.unwrap()];
        let expected = [observation, entrance, value].map(|text| text.parse::<f64>().unwrap());
        assert_eq!(found, expected, "{name}");
        assert_eq!(row.quantity, Quantity::RetroReflectionCoefficient, "{name}");
    }
    // What is written says the same in the one way that this crate writes.
    let written = table.to_csv(&[]);
    assert!(written.lines().next().unwrap().contains("observation_deg,entrance_deg,value"), "{written}");
    let again =
        Table::parse_values(written.as_bytes(), "t.csv").unwrap_or_else(|e| panic!("{name}: {e}\n{written}"));
    for (a, b) in table.rows().iter().zip(again.rows()) {
        assert_eq!((a.geometry(), a.value, a.quantity), (b.geometry(), b.value, b.quantity), "{name}");
        assert_eq!((a.uncertainty, a.limit), (b.uncertainty, b.limit), "{name}");
        assert_eq!(a.cells, b.cells, "{name}");
    }
}

#[test]
fn sheets_are_read_in_every_form_that_says_what_it_means() {
    let with = |header: &'static str| Style { header, ..PLAIN };
    let german = |header: &'static str| Style { header, ..GERMAN };
    let styles = [
        ("plain", PLAIN),
        ("semicolons, decimal commas, CRLF", GERMAN),
        ("semicolons and points", Style { comma: false, ..GERMAN }),
        ("byte order mark, semicolons", Style { before: "\u{feff}", ..GERMAN }),
        ("byte order mark", Style { before: "\u{feff}", ..PLAIN }),
        (
            "tabs and decimal commas",
            Style { header: "observation_deg\tentrance_deg\tvalue\tunit", separator: "\t", ..GERMAN },
        ),
        ("bars", Style { header: "observation_deg|entrance_deg|value|unit", separator: "|", ..PLAIN }),
        ("an old Macintosh", Style { end: "\r", ..PLAIN }),
        ("sep=", Style { before: "sep=;\r\n", ..GERMAN }),
        ("empty lines and remarks before it", Style { before: "\n# goniophotometer 3\n;;;\n", ..GERMAN }),
        ("capitals", with("OBSERVATION_DEG,Entrance_Deg,VALUE,Unit")),
        ("spaces around names", with(" observation_deg , entrance_deg ,value, unit")),
        ("obs, ent", with("obs,ent,value,unit")),
        ("alpha, beta", with("alpha,beta,RA,unit")),
        ("alpha, beta_1", with("Alpha,Beta_1,R_A,Units")),
        ("Greek", with("α,β,SIA,unit")),
        ("Greek with indices", with("α,β₁,R_A,unit")),
        ("words", with("Observation angle,Entrance angle,Coefficient of retroreflection,unit")),
        ("words with degree signs", with("Observation Angle (°),Entrance Angle [°],value,unit")),
        ("words with units", with("Obs. angle in deg,entrance / deg,R_A in cd/lx/m2,unit")),
        ("words with symbols", with("Observation angle α [deg],Entrance angle (β),value,unit")),
        ("German words", german("Beobachtungswinkel [Grad];Anleuchtungswinkel (°);Messwert;Einheit")),
        ("a unit in the header", Style { after: "", ..with("obs,ent,R_A (cd/lx/m2)") }),
        ("a unit with brackets", Style { after: "", ..with("obs,ent,R_A [cd/(lx·m²)]") }),
        ("no unit at all", Style { after: "", ..with("obs,ent,RA") }),
        ("a quantity in brackets", with("obs,ent,value (R_A),unit")),
        ("minutes by name", Style { minutes: true, ..with("observation_min,entrance_deg,value,unit") }),
        ("minutes by unit", Style { minutes: true, ..with("alpha ('),beta (°),value,unit") }),
        ("arcmin", Style { minutes: true, ..german("obs [arcmin];ent [deg];value;unit") }),
        ("degree signs in cells", Style { degree_sign: true, ..PLAIN }),
        ("degree signs and commas", Style { degree_sign: true, ..GERMAN }),
        ("rows that are padded", Style { after: "cd/lx/m2,,,", ..PLAIN }),
        ("rows of separators", Style { end: "\r\n;;;\r\n", ..GERMAN }),
        ("other units' spelling", Style { after: "cd·lx⁻¹·m⁻²", ..PLAIN }),
        ("the unit of old sheets", Style { after: "cd/fc/ft2", ..PLAIN }),
    ];
    for (name, style) in styles {
        check(style.text().as_bytes(), name);
    }
    let quoted = PLAIN.text().replace("380.5", "\"380,5\"").replace("75.25", "\"75,25\"");
    check(quoted.as_bytes(), "quoted decimal commas between commas");
    let latin: Vec<u8> = german("Beobachtungswinkel (°);Anleuchtungswinkel (°);Wert;Einheit")
        .text()
        .chars()
        .map(|c| u8::try_from(u32::from(c)).unwrap())
        .collect();
    check(&latin, "ISO 8859-1");
    let rewritten =
        |from: &str, to: &str, text: String| text.replace(&format!("\n{from},"), &format!("\n{to},"));
    let minutes = rewritten("0.2", "12'", PLAIN.text());
    let minutes = rewritten("0.5", "0°30'", rewritten("1.5", "90 min", minutes));
    check(minutes.as_bytes(), "minutes in cells");
    let minus = PLAIN.text().replace("-4", "\u{2212}4");
    check(minus.as_bytes(), "a minus sign");
}

#[test]
fn what_a_header_says_goes_for_every_row() {
    let text = "obs;ent;R_L (mcd/lx/m2);u (%)\n1,05;88,76;150;3\n";
    let error = Table::parse_values(text.as_bytes(), "t.csv").unwrap_err().to_string();
    assert!(error.contains("column \"u (%)\": give the standard uncertainty"), "{error}");
    let text = text.replace("u (%)", "uncertainty (%)");
    let table = Table::parse_values(text.as_bytes(), "t.csv").unwrap();
    let row = &table.rows()[0];
    assert_eq!((row.quantity, row.value), (Quantity::RetroReflectedLuminance, Some(0.15)));
    assert!((row.uncertainty.unwrap() - 0.0045).abs() < 1e-15);
    let written =
        "observation_deg,entrance_deg,value,uncertainty,unit,quantity\n1.05,88.76,150,3%,mcd/lx/m2,R_L\n";
    assert_eq!(table.to_csv(&[]), written);
}

#[test]
fn every_column_of_a_measurement_is_read() {
    let text = "observation_deg,entrance_deg,beta_2_deg,rotation_deg,value,unit,uncertainty,wavelength_nm,\
                source_aperture_deg,receiver_aperture_deg,limit\n\
                0.2,5,10,90,70,cd/lx/m2,2,905,0.1,0.05,minimum\n0.2,5,,,70,cd/lx/m2,2.5%,,,,\n";
    let table = Table::parse_values(text.as_bytes(), "t.csv").unwrap();
    let [first, second] = table.rows() else { panic!("{table:?}") };
    assert_eq!((first.entrance_2_deg, first.rotation_deg, first.uncertainty), (10.0, 90.0, Some(2.0)));
    assert_eq!((first.wavelength_nm, first.limit, first.unit), (Some(905.0), Limit::Minimum, Unit::ALL[0]));
    let apertures = first.apertures.unwrap();
    assert!((apertures.source.to_degrees() - 0.1).abs() < 1e-15 && apertures.receiver < apertures.source);
    assert_eq!((second.entrance_2_deg, second.wavelength_nm, second.apertures), (0.0, None, None));
    assert_eq!(second.uncertainty, Some(1.75));
    // The angle beta of the directions: cos beta = cos beta_1 cos beta_2.
    let cos = first.geometry().wi.z;
    assert!((cos - 5_f64.to_radians().cos() * 10_f64.to_radians().cos()).abs() < 1e-15);
    assert_eq!(table.to_csv(&[]), text);
}

#[test]
fn what_can_be_read_two_ways_or_none_is_refused_with_the_cure() {
    let cases: &[(&str, &str)] = &[
        ("a;b\n1;2\n", "t.csv: missing columns observation_deg, entrance_deg, value; there are \"a\", \"b\""),
        ("0.2,-4,380,cd/lx/m2\n", "`catseye fit --help` lists the names that are read"),
        ("0.2;-4;380\n0.2;30;215\n", "the first line has to name the columns"),
        (
            "obs ent value\n0.2 5 70\n",
            "all there is is \"obs ent value\": separate columns with `,`, `;` or tabs",
        ),
        ("obs,ent,x;y;value;unit\n", "the header can be read with `;` and with `,` between columns; use one"),
        ("obs,alpha,ent,value\n", "columns \"obs\" and \"alpha\" both mean observation_deg"),
        ("observation_min,observation_deg,ent,value\n", "both mean observation_deg"),
        (
            "alpha (rad),ent,value\n",
            "\"rad\" is no unit that it can have; degrees (deg) and minutes of arc (min)",
        ),
        ("obs,ent,R_A (lux)\n", "column \"R_A (lux)\": \"lux\" is no unit that it can have"),
        ("obs,ent,presentation,value\n", "is an angle of another goniometer system"),
        ("obs,ent,value,expanded uncertainty\n0.2,5,70,3\n", "give the standard uncertainty"),
        ("obs,ent,value,uncertainty (k=2)\n0.2,5,70,3\n", "give the standard uncertainty"),
        ("obs,ent,value,uncertainty\n0.2,5,70,-3\n", "t.csv:2: column uncertainty: \"-3\" is not above 0"),
        ("obs,ent,value,uncertainty\n0.2,5,70,300%\n", "in percent (3%)"),
        (
            "obs,ent,value,uncertainty (mcd/lx/m2)\n0.2,5,70,300\n",
            "is in mcd/lx/m2, but the value in cd/lx/m2",
        ),
        ("obs,ent,value,source_aperture_deg\n0.2,5,70,0.1\n", "both apertures are needed"),
        (
            "obs,ent,value,source_aperture_deg,receiver_aperture_deg\n0.2,5,70,0.1,30\n",
            "30 is outside [0, 20]",
        ),
        ("obs,ent,value,wavelength\n0.2,5,70,0.905\n", "0.905 is outside [100, 20000] nm"),
        ("obs,ent,beta_2,value\n0.2,5,95,70\n", "t.csv:2: column beta_2: 95 is outside (-90, 90)"),
        (
            "obs,ent,value\n0,2,-4,380,5\n",
            "5 fields, but the header has 3; if decimals have commas, separate",
        ),
        ("obs;ent;value\n0,2;-4;1.350\n", "\"1.350\" could have a sign between thousands or before decimals"),
        ("obs;ent;value\n0.2;-4;1,350\n", "\"1,350\" could have a sign between thousands or before decimals"),
        (
            "obs;ent;value\n0,2;-4;1.350,5\n",
            "\"1.350,5\" could have a sign between thousands or before decimals",
        ),
        ("obs;ent;value\n0,2;-4;1 350\n", "\"1 350\" is not a number; write it without spaces"),
        (
            "obs;ent;value\n0,2;-4;>=215\n",
            "\">=215\" is not a number; write the number, and minimum or maximum",
        ),
        ("obs;ent;value\n0,2;-4;<75\n", "write the number, and minimum or maximum in a column limit"),
        (
            "obs;ent;value\n0,2;-4;35%\n",
            "\"35%\" is not a number; write the number, and % in the column unit",
        ),
        ("obs;ent;value\n0,2;-4;0\n", "t.csv:2: column value: is 0; leave the row out"),
        (
            "obs;ent;value;unit\n0,2;-4\n",
            "t.csv:2: 2 fields, but the header has 4; is a cell or a quote missing?",
        ),
        ("obs;ent;R_A (cd/lx/m2);unit\n0,2;-4;7;%\n", "column unit: % is not cd/lx/m2, as the header says"),
        ("obs;ent;R_A;quantity\n0,2;-4;7;R_L\n", "column quantity: R_L is not R_A, as the header says"),
        ("obs;ent;value\n0,2;-4;\"7\n0,2;30;5\n", "t.csv:2: column value: \"7\\n0,2;30;5\" is not a number"),
        (
            "obs,ent,value\n0.2,\u{0},7\n",
            "t.csv:2: is no text, or not in UTF-8; save the table as CSV in UTF-8",
        ),
    ];
    for (text, expected) in cases {
        let error = Table::parse_values(text.as_bytes(), "t.csv").expect_err(text).to_string();
        assert!(error.contains(expected), "{text:?}\n gave   {error}\n wanted {expected}");
        assert!(error.lines().count() == 1 && error.len() < 400, "{error}");
    }
}

#[test]
fn hostile_tables_are_refused_in_a_line() {
    let header = "obs,ent,value,unit,class\n";
    let long = "x".repeat(5 << 20);
    let cases = [
        (format!("{header}0.2,5,70,cd/lx/m2,{long}\n"), "t.csv:2: a cell that begins with"),
        (format!("{header}0.2,5,70,\"{long}\n"), "t.csv:2: a cell that begins with"),
        (format!("{long},{header}0.2\n"), "does not end; is a quote left open?"),
        (format!("{}\n1\n", "a,".repeat(100_000)), "has 100001 columns; at most 200 are read"),
        (header.to_owned() + &"1,1,7,,\n".repeat(1_000_000), "has more than 250000 rows; split it"),
        (header.to_owned() + &"0.1234567,1.2345,7,,\n".repeat(1_000_000), "is larger than 16 MiB"),
        (header.to_owned() + &"\"".repeat(1 << 20), "is a quote left open?"),
        (";".repeat(1 << 20), "t.csv: is empty"),
    ];
    for (text, expected) in cases {
        let error = Table::parse_values(text.as_bytes(), "t.csv").unwrap_err().to_string();
        let start: String = error.chars().take(300).collect();
        assert!(error.contains(expected), "{start}\n wanted {expected}");
        assert!(error.lines().count() == 1 && error.len() < 300, "{start}");
    }
    let utf_16: Vec<u8> = "\u{feff}obs,ent\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let picture = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR";
    for bytes in [&utf_16[..], picture, &[0xff; 1 << 16]] {
        let error = Table::parse_values(bytes, "t.csv").unwrap_err().to_string();
        assert!(error.contains("save the table as CSV in UTF-8"), "{error}");
    }
}

#[test]
fn oddities_are_hinted_at() {
    let hints = |text: &str| Table::parse_values(text.as_bytes(), "t.csv").unwrap().hints();
    assert!(hints(&PLAIN.text()).iter().all(|hint| hint.contains("1 values are below a ten thousandth")));
    let minutes = hints("obs,ent,value\n12,-4,380\n12,30,215\n30,-4,135\n30,30,75\n");
    assert!(minutes.len() == 1 && minutes[0].contains("are they minutes of arc?"), "{minutes:?}");
    let swapped = hints("obs,ent,value\n4,0.2,380\n30,0.2,215\n4,0.5,135\n30,0.5,75\n");
    assert!(swapped.len() == 1 && swapped[0].contains("have the two columns changed places?"), "{swapped:?}");
    // A table by day, and one of a wide bead.
    assert!(hints("obs,ent,value,unit\n45,45,0.3,1\n").is_empty());
    assert!(hints("obs,ent,value\n0.2,-4,380\n20,-4,0.3\n").is_empty());
}

#[test]
fn repeated_values_may_differ_by_their_uncertainties() {
    let read = |text: &str| Table::parse_values(text.as_bytes(), "t.csv").map_err(|error| error.to_string());
    assert!(read("obs,ent,value\n2,5,0.010\n2,5,0.012\n").unwrap_err().contains("t.csv:3: says R_A = 0.012"));
    assert!(read("obs,ent,value,uncertainty\n2,5,0.010,0.001\n2,5,0.012,0.001\n").is_ok());
    assert!(read("obs,ent,value,uncertainty\n2,5,0.010,0.0001\n2,5,0.012,1%\n").is_err());
    assert!(read("obs,ent,value,wavelength_nm\n2,5,70,555\n2,5,20,905\n").is_ok());
}
