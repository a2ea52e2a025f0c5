//! Small documents for the tests.

/// A document whose material `m` shows the node named `bsdf`, which is among `nodes`; these start in line 2.
pub(crate) fn document(nodes: &str) -> String {
    format!(
        r#"<materialx version="1.39">
{nodes}
<surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="bsdf" /></surface>
<surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s" /></surfacematerial>
</materialx>"#
    )
}

/// A document whose material shows one node of this category with these inputs, which start in line 3.
pub(crate) fn single(category: &str, inputs: &str) -> String {
    document(&format!("<{category} name=\"bsdf\" type=\"BSDF\">\n{inputs}\n</{category}>"))
}
