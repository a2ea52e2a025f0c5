//! Prints what the outputs of MaterialX documents are at points of a surface.
//!
//! `outputs POINTS < DOCUMENTS`: a line of POINTS is a point (position in the world, in the object, normal,
//! tangent, bitangent, texture coordinates, view: 20 numbers); documents are separated by form feeds. For
//! each document, for each of its outputs, for each point, a line: four numbers, or in place of all of them
//! `error: ` and why; then a form feed. Definitions and pictures come from the folders of
//! `MATERIALX_SEARCH_PATH`.
//!
//! `outputs --categories` prints the categories of nodes that are built in.
#![expect(clippy::print_stdout, reason = "this is what it is for")]

use std::{env, error::Error, fs, io::read_to_string, io::stdin, sync::Arc};

use catseye_materialx::{Document, Library, SearchPath, ShadingPoint, pattern_categories};

fn point(line: &str) -> Option<ShadingPoint> {
    let numbers: Vec<f32> = line.split_whitespace().map(|x| x.parse().ok()).collect::<Option<_>>()?;
    let [position, position_object, normal, tangent, bitangent] =
        [0, 3, 6, 9, 12].map(|i| [numbers[i], numbers[i + 1], numbers[i + 2]]);
    let (texcoord, view) = ([numbers[15], numbers[16]], [numbers[17], numbers[18], numbers[19]]);
    Some(ShadingPoint { position, position_object, normal, tangent, bitangent, texcoord, view })
}

fn print(
    text: &str,
    library: &Arc<Library>,
    points: &[ShadingPoint],
) -> Result<(), catseye_materialx::Error> {
    for output in Document::parse_with(text, "document", library)?.outputs()? {
        for point in points {
            let [x, y, z, w] = output.at(point);
            println!("{x} {y} {z} {w}");
        }
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let file = env::args().nth(1).ok_or("usage: outputs POINTS < DOCUMENTS")?;
    if file == "--categories" {
        pattern_categories().for_each(|category| println!("{category}"));
        return Ok(());
    }
    let points: Option<Vec<_>> = fs::read_to_string(file)?.lines().map(point).collect();
    let points = points.ok_or("a point has 20 numbers")?;
    let library = Arc::new(Library::load(SearchPath::from_env())?);
    for text in read_to_string(stdin())?.split('\x0c') {
        if let Err(problem) = print(text, &library, &points) {
            println!("error: {problem}");
        }
        println!("\x0c");
    }
    Ok(())
}
