//! What every file says of itself.

use serde_json::{Map, Value, json};

/// Version of the format that is written.
const VERSION: &str = "1.0.0";
/// Where the schemas of that version are.
const SCHEMAS: &str = "https://raw.githubusercontent.com/asam-ev/OpenMATERIAL-3D/refs/tags/v1.0.0/schemas";

/// Who made a material, and what others may do with it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Metadata {
    /// Display name.
    pub name: String,
    /// Two or three sentences.
    pub description: String,
    /// Copyright notices; at least one.
    pub copyrights: Vec<String>,
    /// SPDX identifier of the licence.
    pub license: String,
    /// Authors; at least one.
    pub authors: Vec<String>,
}

impl Metadata {
    /// A material that nothing but the name is known of. The schemas want copyright, licence and author; they
    /// say so.
    #[must_use]
    pub fn named(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            description: String::new(),
            copyrights: vec!["not stated".to_owned()],
            // What SPDX has for "not stated".
            license: "NOASSERTION".to_owned(),
            authors: vec!["not stated".to_owned()],
        }
    }

    /// A document with these metadata, and with `sources` among them where the schema wants that.
    ///
    /// No date: the same material makes the same file.
    pub(super) fn document(&self, schema: &str, kind: &str, sources: Option<&str>) -> Map<String, Value> {
        let mut metadata = json!({
            "name": self.name,
            "uuid": self.uuid(kind),
            "materialVersion": VERSION,
            "openMaterial3dVersion": VERSION,
            "copyrights": self.copyrights,
            "license": self.license,
            "authors": self.authors,
        });
        if !self.description.is_empty() {
            metadata["description"] = self.description.as_str().into();
        }
        if let Some(sources) = sources {
            metadata["sources"] = sources.into();
        }
        let schema = format!("{SCHEMAS}/{schema}.json");
        Map::from_iter([("$schema".to_owned(), schema.into()), ("metadata".to_owned(), metadata)])
    }

    /// An identifier that depends on the name and the kind of file only: a UUID of version 8 (RFC 9562,
    /// section 5.8), for numbers of one's own making.
    fn uuid(&self, kind: &str) -> String {
        let text = format!("catseye/{kind}/{}", self.name);
        // FNV-1a with 128 bits (Fowler, Noll and Vo).
        let hash = text.bytes().fold(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d_u128, |hash, byte| {
            (hash ^ u128::from(byte)).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013b)
        });
        let marked = hash & !(0xf << 76) & !(0x3 << 62) | 0x8 << 76 | 0x2 << 62;
        let hex = format!("{marked:032x}");
        [&hex[..8], &hex[8..12], &hex[12..16], &hex[16..20], &hex[20..]].join("-")
    }
}
