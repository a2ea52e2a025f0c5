//! Bytes as text: UTF-8, UTF-16, and ISO-8859-1 where a document declares it, as MaterialX reads them.

use std::borrow::Cow;

use crate::{
    error::{Error, Place},
    text::source::Source,
};

/// The document's text, without a byte order mark where it is UTF-16.
pub(crate) fn decode<'a>(bytes: &'a [u8], name: &str) -> Result<Cow<'a, str>, Error> {
    match bytes {
        [0xff, 0xfe, rest @ ..] => utf16(rest, u16::from_le_bytes, name),
        [0xfe, 0xff, rest @ ..] => utf16(rest, u16::from_be_bytes, name),
        // Without the mark: the `<` that XML starts with.
        [b'<', 0, ..] => utf16(bytes, u16::from_le_bytes, name),
        [0, b'<', ..] => utf16(bytes, u16::from_be_bytes, name),
        _ if declares_latin1(bytes) => Ok(bytes.iter().copied().map(char::from).collect()),
        _ => match str::from_utf8(bytes) {
            Ok(text) => Ok(Cow::Borrowed(text)),
            Err(cause) => {
                let valid = String::from_utf8_lossy(&bytes[..cause.valid_up_to()]);
                Err(Error::Encoding { at: end_of(&valid, name), encoding: "UTF-8" })
            }
        },
    }
}

fn utf16<'a>(bytes: &[u8], unit: fn([u8; 2]) -> u16, name: &str) -> Result<Cow<'a, str>, Error> {
    let pairs = bytes.chunks_exact(2);
    let rest = pairs.remainder();
    let mut text = String::new();
    for character in char::decode_utf16(pairs.map(|pair| unit([pair[0], pair[1]]))) {
        match character {
            Ok(character) => text.push(character),
            Err(_) => return Err(Error::Encoding { at: end_of(&text, name), encoding: "UTF-16" }),
        }
    }
    if rest.is_empty() {
        Ok(Cow::Owned(text))
    } else {
        Err(Error::Encoding { at: end_of(&text, name), encoding: "UTF-16" })
    }
}

/// Whether the XML declaration names ISO-8859-1.
fn declares_latin1(bytes: &[u8]) -> bool {
    /// Bytes of an XML declaration; it comes first and is short.
    const LONGEST: usize = 200;
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(LONGEST)]).to_ascii_lowercase();
    let declaration = head.strip_prefix("<?xml").and_then(|rest| rest.split_once("?>"));
    let encoding = declaration.and_then(|(declaration, _)| declaration.split_once("encoding"));
    encoding.is_some_and(|(_, value)| {
        let value = value.trim_start_matches(|c: char| c == '=' || c.is_whitespace());
        ["iso-8859-1", "latin1"]
            .iter()
            .any(|known| value.get(1..).is_some_and(|value| value.starts_with(known)))
    })
}

fn end_of(text: &str, name: &str) -> Place {
    Source::new(name, text).place(text.len(), String::new())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn utf16_and_latin1_are_text() {
        let text = "<?xml version=\"1.0\" encoding=\"UTF-16\"?><m a=\"\u{fc}\u{1f9ff}\"/>";
        let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
        let marked = |mark: [u8; 2], bytes: &[u8]| [&mark, bytes].concat();
        for bytes in [&little, &big, &marked([0xff, 0xfe], &little), &marked([0xfe, 0xff], &big)] {
            assert_eq!(decode(bytes, "m").unwrap(), text);
        }
        let latin = b"<?xml version='1.0' encoding='ISO-8859-1'?><m a='\xfc'/>";
        assert!(decode(latin, "m").unwrap().ends_with("<m a='\u{fc}'/>"));
    }

    #[test]
    fn what_is_none_of_them_is_refused_with_its_place() {
        let message = |bytes: &[u8]| decode(bytes, "m").unwrap_err().to_string();
        let expected = "m:2:2: is not UTF-8 from here on; save the file as UTF-8";
        assert_eq!(message(b"<a\n \xfc/>"), expected);
        assert_eq!(
            message(b"\xff\xfe<\0a\0\x00\xd8/\0"),
            "m:1:3: is not UTF-16 from here on; save the file as UTF-8"
        );
        assert_eq!(message(b"\xff\xfe<\0a"), "m:1:2: is not UTF-16 from here on; save the file as UTF-8");
    }
}
