//! A material of one retro-reflective lobe, for the tests of what is measured of it.

use crate::run::Bench;

/// A lobe of the given roughness, tint (0.06, 0.05, 0.02).
pub(crate) fn document(roughness: &str) -> String {
    format!(
        r#"<materialx version="1.39" colorspace="lin_rec709">
          <retro_reflective_bsdf name="beads" type="BSDF">
            <input name="roughness_u" type="float" value="{roughness}" />
            <input name="tint" type="color3" value="0.06, 0.05, 0.02" />
          </retro_reflective_bsdf>
          <surface name="skin" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="beads" /></surface>
          <surfacematerial name="m" type="material">
            <input name="surfaceshader" type="surfaceshader" nodename="skin" />
          </surfacematerial>
        </materialx>"#
    )
}

/// A folder with `m.mtlx`, whose roughness is 0.006.
pub(crate) fn bench() -> Bench {
    let bench = Bench::new();
    bench.write("m.mtlx", &document("0.006"));
    bench
}

/// Standard output of a measurement of `m.mtlx` that succeeds.
pub(crate) fn measured(args: &str, stdin: &str) -> String {
    let outcome = bench().catseye(&format!("measure m.mtlx {args}"), stdin);
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{args}");
    outcome.stdout
}
