//! Whatever BSDF the reader knows is rendered.

use catseye_materialx::{Document, bsdf_categories};
use catseye_render::Bsdf;

/// A new node of the reader is dealt with here too: the closures are not exhaustive.
#[test]
fn every_bsdf_of_the_reader_is_rendered() {
    for category in bsdf_categories() {
        let text = format!(
            r#"<materialx version="1.39"><{category} name="b" type="BSDF" />
            <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b" /></surface>
            <surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s" /></surfacematerial></materialx>"#
        );
        let material =
            Document::parse(&text, category).and_then(|document| document.material(None)).expect(&text);
        Bsdf::new(&material.surface.bsdf).expect(category);
    }
}
