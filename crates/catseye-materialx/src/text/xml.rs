//! From text to a tree of elements, in bounded time and memory whatever the text.

use std::{borrow::Cow, sync::Arc};

use roxmltree::{Node, ParsingOptions};

use crate::{
    error::{Error, one_line},
    text::{
        element::{Attribute, Element, Inherited, Span},
        source::Source,
    },
};

/// Elements, texts and comments of a document. MaterialX's own libraries together have about 30,000.
const MAX_XML_NODES: u32 = 500_000;
/// Elements inside elements; MaterialX itself needs four.
const MAX_NESTING: usize = 32;
/// Quotes in one tag, two for each attribute: roxmltree compares every attribute of an element with every
/// other.
const MAX_QUOTES: usize = 256;
/// Namespace declarations: roxmltree copies those of the parent into every child that declares another.
const MAX_NAMESPACES: usize = 64;

/// Bytes of one attribute, except `doc`: names and values are hashed and parsed wherever they are referred
/// to.
const MAX_ATTRIBUTE: usize = 4096;

const XINCLUDE: &str = "http://www.w3.org/2001/XInclude";
/// What stands in front of a prefix that a document doesn't declare; MaterialX takes it as part of the name.
const UNDECLARED: &str = "undeclared:";
/// Prefixes that a document doesn't declare: each takes another reading.
const MAX_UNDECLARED: usize = 8;

/// Parses the text and returns its root element.
pub(crate) fn parse(source: &Arc<Source>) -> Result<Element, Error> {
    refuse_quadratic(source)?;
    let mut reading = Reading::of(source);
    loop {
        let options =
            ParsingOptions { allow_dtd: false, nodes_limit: MAX_XML_NODES, ..ParsingOptions::default() };
        let undeclared = match roxmltree::Document::parse_with_options(&reading.text, options) {
            Ok(xml) => return reading.convert(xml.root_element(), &Inherited::default(), 1),
            Err(roxmltree::Error::UnknownNamespace(prefix, _)) if reading.declared < MAX_UNDECLARED => prefix,
            Err(cause) => return Err(xml_error(source, &cause)),
        };
        reading.declare(&undeclared);
    }
}

/// Tokens in file names, which MaterialX writes as they are though XML has no `<` in attributes, and what
/// stands for them while the XML is read: as many bytes, so that places stay.
const TOKENS: [(&str, &str); 2] = [("<UDIM>", "%UDIM%"), ("<UVTILE>", "%UVTILE%")];

/// The text that is parsed: the document's, with what MaterialX's parser doesn't mind made good.
struct Reading<'a> {
    source: &'a Arc<Source>,
    text: Cow<'a, str>,
    has_tokens: bool,
    /// Where declarations of namespaces were added, and how many bytes.
    added: (usize, usize),
    declared: usize,
}

/// Refuses what the XML parser needs quadratic time for.
///
/// A `<` ends every tag for this purpose: it can't stand inside one, not even in an attribute's value.
fn refuse_quadratic(source: &Source) -> Result<(), Error> {
    let text = source.text();
    let limit_at =
        |offset, what, limit| Error::Limit { at: source.place(offset, String::new()), what, limit };
    if let Some((offset, _)) = text.match_indices("xmlns").nth(MAX_NAMESPACES) {
        return Err(limit_at(offset, "namespace declarations", MAX_NAMESPACES));
    }
    let mut quotes = 0;
    for (offset, byte) in text.bytes().enumerate() {
        match byte {
            b'<' => quotes = 0,
            b'"' | b'\'' => quotes += 1,
            _ => {}
        }
        if quotes > MAX_QUOTES {
            return Err(limit_at(offset, "quotes before the next <", MAX_QUOTES));
        }
    }
    Ok(())
}

fn xml_error(source: &Source, cause: &roxmltree::Error) -> Error {
    use roxmltree::Error as Xml;
    let text = source.text();
    let place = |offset| source.place(offset, String::new());
    match cause {
        Xml::DtdDetected => Error::DocumentType { at: place(text.find("<!DOCTYPE").unwrap_or(0)) },
        Xml::NodesLimitReached => {
            Error::Limit { at: place(0), what: "XML nodes", limit: MAX_XML_NODES as usize }
        }
        // These have no position of their own: the text ends too early.
        Xml::NoRootNode | Xml::UnclosedRootNode | Xml::UnexpectedEndOfStream => {
            Error::Xml { at: place(text.len()), message: cause.to_string() }
        }
        _ => {
            let position = cause.pos();
            let mut at = place(0);
            (at.line, at.column) = (position.row, position.col);
            // The position stands in front already.
            Error::Xml { at, message: one_line(&cause.to_string().replace(&format!(" at {position}"), "")) }
        }
    }
}

impl<'a> Reading<'a> {
    fn of(source: &'a Arc<Source>) -> Self {
        let mut text = Cow::Borrowed(source.text());
        for (token, stand_in) in TOKENS {
            if text.contains(token) {
                text = Cow::Owned(text.replace(token, stand_in));
            }
        }
        let has_tokens = matches!(text, Cow::Owned(_));
        Self { source, text, has_tokens, added: (root_name_end(source.text()), 0), declared: 0 }
    }

    /// Declares a prefix at the root: MaterialX knows no namespaces of XML.
    fn declare(&mut self, prefix: &str) {
        let declaration = format!(" xmlns:{prefix}='{UNDECLARED}{prefix}'");
        let (at, length) = self.added;
        self.text.to_mut().insert_str(at, &declaration);
        self.added = (at, length + declaration.len());
        self.declared += 1;
    }

    /// Copies an element out of the parser's tree; recursion is bounded by [`MAX_NESTING`].
    fn convert(&self, node: Node<'_, '_>, inherited: &Inherited, depth: usize) -> Result<Element, Error> {
        let (at, length) = self.added;
        let start = node.range().start;
        let span = Span::new(self.source, if start > at { start - length } else { start });
        if depth > MAX_NESTING {
            return Err(Error::Limit {
                at: span.place(String::new()),
                what: "levels of elements inside elements",
                limit: MAX_NESTING,
            });
        }
        if node.attributes().any(|a| a.name() != "doc" && a.value().len() > MAX_ATTRIBUTE) {
            return Err(Error::Limit {
                at: span.place(String::new()),
                what: "bytes in an attribute",
                limit: MAX_ATTRIBUTE,
            });
        }
        let inherited = inherit(node, inherited);
        let children = node
            .children()
            .filter(|child| is_materialx(*child))
            .map(|child| self.convert(child, &inherited, depth + 1))
            .collect::<Result<_, _>>()?;
        let own = node.attributes().filter(|a| a.namespace().is_none());
        let attributes = own.map(|a| Attribute::new(a.name(), &self.with_tokens(a.value()))).collect();
        Ok(Element::new(tag(node), attributes, children, span, inherited))
    }

    fn with_tokens<'t>(&self, value: &'t str) -> Cow<'t, str> {
        let mut value = Cow::Borrowed(value);
        for (token, stand_in) in TOKENS {
            if self.has_tokens && value.contains(stand_in) {
                value = Cow::Owned(value.replace(stand_in, token));
            }
        }
        value
    }
}

/// Where the name of the root element ends; the text's end where there is none.
fn root_name_end(text: &str) -> usize {
    let mut at = 0;
    while let Some(start) = text[at..].find('<') {
        let rest = &text[at + start..];
        let skipped = if rest.starts_with("<?") {
            rest.find("?>")
        } else if rest.starts_with("<!--") {
            rest.find("-->")
        } else {
            let length = rest.find(|c: char| c.is_whitespace() || matches!(c, '/' | '>'));
            return at + start + length.unwrap_or(rest.len());
        };
        match skipped {
            Some(length) => at += start + length,
            None => return text.len(),
        }
    }
    text.len()
}

/// What a node has of its own, and what it has of those around it.
fn inherit(node: Node<'_, '_>, outer: &Inherited) -> Inherited {
    let own = |name| node.attribute(name).filter(|value| !value.is_empty());
    let prefix = |own: &str| match &outer.fileprefix {
        // Bounded: a prefix is an attribute, and nesting is limited.
        Some(outer) => Arc::from(format!("{outer}{own}")),
        None => Arc::from(own),
    };
    Inherited {
        colorspace: own("colorspace").map(Arc::from).or_else(|| outer.colorspace.clone()),
        fileprefix: own("fileprefix").map(prefix).or_else(|| outer.fileprefix.clone()),
    }
}

/// Elements in other tools' namespaces are theirs to read; an include is ours to see.
fn is_materialx(node: Node<'_, '_>) -> bool {
    let namespace = node.tag_name().namespace();
    let document = node.document().root_element().tag_name().namespace();
    node.is_element()
        && (namespace == document
            || namespace.is_some_and(|uri| uri == XINCLUDE || uri.starts_with(UNDECLARED)))
}

fn tag(node: Node<'_, '_>) -> String {
    let name = node.tag_name();
    match name.namespace() {
        Some(XINCLUDE) => format!("xi:{}", name.name()),
        Some(uri) if uri.starts_with(UNDECLARED) => format!("{}:{}", &uri[UNDECLARED.len()..], name.name()),
        _ => name.name().to_owned(),
    }
}
