//! What pictures may take of memory.

use std::fs::File;
use std::io::Write as _;

use crate::run::Bench;

/// The largest picture by its pixels: half a gigabyte of numbers in half a megabyte.
const SIDE: usize = 8192;

fn write_large_png(bench: &Bench, name: &str) {
    let mut encoder = png::Encoder::new(File::create(bench.path(name)).unwrap(), SIDE as u32, SIDE as u32);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Sixteen);
    encoder.set_compression(png::Compression::Fast);
    let mut header = encoder.write_header().unwrap();
    let mut rows = header.stream_writer().unwrap();
    let row = vec![0; SIDE * 8];
    (0..SIDE).for_each(|_| rows.write_all(&row).unwrap());
    rows.finish().unwrap();
}

fn document(pictures: usize) -> String {
    let image = |i| {
        format!(
            "<image name=\"p{i}\" type=\"color3\"><input name=\"file\" type=\"filename\" value=\"{i}.png\" /></image>\n\
             <oren_nayar_diffuse_bsdf name=\"d{i}\" type=\"BSDF\">\
             <input name=\"color\" type=\"color3\" nodename=\"p{i}\" /></oren_nayar_diffuse_bsdf>\n\
             <add name=\"a{i}\" type=\"BSDF\"><input name=\"in1\" type=\"BSDF\" nodename=\"d{i}\" />{}</add>\n",
            if i == 0 {
                String::new()
            } else {
                format!("<input name=\"in2\" type=\"BSDF\" nodename=\"a{}\" />", i - 1)
            }
        )
    };
    let nodes: String = (0..pictures).map(image).collect();
    format!(
        "<materialx version=\"1.39\">\n{nodes}<surface name=\"s\" type=\"surfaceshader\">\
         <input name=\"bsdf\" type=\"BSDF\" nodename=\"a{}\" /></surface>\n\
         <surfacematerial name=\"m\" type=\"material\">\
         <input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"s\" /></surfacematerial></materialx>",
        pictures - 1
    )
}

#[test]
fn pictures_stay_below_a_gigabyte_and_memory_that_is_not_there_is_an_error() {
    let bench = Bench::new();
    write_large_png(&bench, "0.png");
    for i in 1..8 {
        std::fs::hard_link(bench.path("0.png"), bench.path(&format!("{i}.png"))).unwrap();
    }
    bench.write("one.mtlx", &document(1));
    bench.write("eight.mtlx", &document(8));
    let measure = "catseye measure";
    // In units of 1024 bytes: everything that the process has, resident or not, below 10^9 bytes.
    let one = bench.shell(&format!("ulimit -v 976562; {measure} one.mtlx"));
    assert_eq!(one.code, 0, "{}", one.stderr);
    for command in [measure, "catseye materialx check"] {
        let eight = bench.shell(&format!("ulimit -v 976562; {command} eight.mtlx"));
        let expected = ".png\" can't be read: with the other pictures it takes more than 640 MiB of memory";
        let message = eight.stdout + &eight.stderr;
        assert!(eight.code == 1 && message.contains(expected), "{message}");
        let less = bench.shell(&format!("ulimit -v 400000; {command} one.mtlx"));
        let expected = "the picture \"0.png\" can't be read: there is not enough memory for it";
        let message = less.stdout + &less.stderr;
        assert!(less.code == 1 && message.contains(expected), "{message}");
    }
}
