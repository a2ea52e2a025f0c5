//! A document's elements, independent of the XML parser and of the file they came from.

use std::sync::Arc;

use crate::{
    error::{Error, Place, quoted},
    text::source::Source,
};

/// Where an element starts.
#[derive(Clone, Debug)]
pub(crate) struct Span {
    source: Arc<Source>,
    offset: usize,
}

impl Span {
    pub(crate) fn new(source: &Arc<Source>, offset: usize) -> Self {
        Self { source: Arc::clone(source), offset }
    }

    pub(crate) fn place(&self, element: String) -> Place {
        self.source.place(self.offset, element)
    }

    pub(crate) fn source(&self) -> &Arc<Source> {
        &self.source
    }

    pub(crate) fn offset(&self) -> usize {
        self.offset
    }
}

/// A name and its text.
#[derive(Debug)]
pub(crate) struct Attribute {
    name: Box<str>,
    value: Box<str>,
}

impl Attribute {
    pub(crate) fn new(name: &str, value: &str) -> Self {
        Self { name: name.into(), value: value.into() }
    }
}

/// An element of a document; its tag is its node category where it is a node.
#[derive(Debug)]
pub(crate) struct Element {
    tag: String,
    attributes: Vec<Attribute>,
    children: Vec<Element>,
    span: Span,
    inherited: Inherited,
}

/// What elements pass on to those inside them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Inherited {
    /// The colour space of values.
    pub(crate) colorspace: Option<Arc<str>>,
    /// What stands in front of file names.
    pub(crate) fileprefix: Option<Arc<str>>,
}

impl Element {
    pub(crate) fn new(
        tag: String,
        attributes: Vec<Attribute>,
        children: Vec<Element>,
        span: Span,
        inherited: Inherited,
    ) -> Self {
        Self { tag, attributes, children, span, inherited }
    }

    /// The same element with other elements inside.
    pub(crate) fn with_children(self, children: Vec<Element>) -> Self {
        Self { children, ..self }
    }

    pub(crate) fn children_mut(&mut self) -> &mut Vec<Element> {
        &mut self.children
    }

    /// The element inside with this tag and name.
    pub(crate) fn child_mut(&mut self, tag: &str, name: &str) -> Option<&mut Element> {
        self.children.iter_mut().find(|child| child.tag == tag && child.name() == Some(name))
    }

    /// An element that the document doesn't have: problems with it are told at this one's place.
    pub(crate) fn sibling(&self, tag: &str, name: &str, ty: &str) -> Self {
        let attributes = vec![Attribute::new("name", name), Attribute::new("type", ty)];
        Self::new(tag.to_owned(), attributes, Vec::new(), self.span.clone(), self.inherited.clone())
    }

    pub(crate) fn set(&mut self, name: &str, value: &str) {
        self.take(name);
        self.attributes.push(Attribute::new(name, value));
    }

    /// Takes an attribute away; `None` where there is none or an empty one.
    pub(crate) fn take(&mut self, name: &str) -> Option<String> {
        let at = self.attributes.iter().position(|attribute| &*attribute.name == name)?;
        Some(self.attributes.remove(at).value.into()).filter(|value: &String| !value.is_empty())
    }

    /// Whether there is such an attribute, with an empty text too.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.attributes.iter().any(|attribute| &*attribute.name == name)
    }

    pub(crate) fn take_children(&mut self) -> Vec<Element> {
        core::mem::take(&mut self.children)
    }

    pub(crate) fn into_children(self) -> Vec<Element> {
        self.children
    }

    /// The document that it stands in.
    pub(crate) fn source(&self) -> &Arc<Source> {
        self.span.source()
    }

    /// Where it starts, in bytes: quicker to find than its line.
    pub(crate) fn offset(&self) -> usize {
        self.span.offset()
    }

    /// What stands in front of the file names of this element.
    pub(crate) fn fileprefix(&self) -> &str {
        self.inherited.fileprefix.as_deref().unwrap_or_default()
    }

    /// The elements inside with this tag.
    pub(crate) fn children_of_kind<'a>(&'a self, tag: &'static str) -> impl Iterator<Item = &'a Element> {
        self.children.iter().filter(move |child| child.tag == tag)
    }

    /// The element inside with this tag and name.
    pub(crate) fn child(&self, tag: &str, name: &str) -> Option<&Element> {
        self.children.iter().find(|child| child.tag == tag && child.name() == Some(name))
    }

    pub(crate) fn tag(&self) -> &str {
        &self.tag
    }

    pub(crate) fn children(&self) -> &[Element] {
        &self.children
    }

    /// The colour space of this element's values: its own or that of the nearest element around it.
    pub(crate) fn colorspace(&self) -> Option<&str> {
        self.inherited.colorspace.as_deref()
    }

    /// The attribute's text; an empty one counts as absent, as in MaterialX.
    pub(crate) fn attribute(&self, name: &str) -> Option<&str> {
        let attribute = self.attributes.iter().find(|attribute| &*attribute.name == name)?;
        Some(&*attribute.value).filter(|value| !value.is_empty())
    }

    pub(crate) fn name(&self) -> Option<&str> {
        self.attribute("name")
    }

    /// The name in quotes, for messages.
    pub(crate) fn quoted_name(&self) -> String {
        quoted(self.name().unwrap_or_default())
    }

    /// The attribute's text, or an error that asks for it.
    pub(crate) fn require(&self, attribute: &'static str) -> Result<&str, Error> {
        self.attribute(attribute).ok_or_else(|| Error::MissingAttribute { at: self.place(), attribute })
    }

    /// The attribute's text of an element inside this one, or an error that asks for it.
    pub(crate) fn require_of<'a>(
        &self,
        child: &'a Element,
        attribute: &'static str,
    ) -> Result<&'a str, Error> {
        child
            .attribute(attribute)
            .ok_or_else(|| Error::MissingAttribute { at: self.place_of(child), attribute })
    }

    /// Where it is, with tag and name, as in `mix "body"`.
    pub(crate) fn place(&self) -> Place {
        self.span.place(self.describe())
    }

    /// Where an element inside this one is, with both names, as in `mix "body", input "fg"`.
    pub(crate) fn place_of(&self, child: &Element) -> Place {
        child.span.place(format!("{}, {}", self.describe(), child.describe()))
    }

    fn describe(&self) -> String {
        /// Tags of MaterialX are short; a hostile one must not fill the screen.
        const LONGEST_TAG: usize = 40;
        let tag = self.tag.chars().take(LONGEST_TAG).collect::<String>();
        match self.name() {
            None => tag,
            Some(name) => format!("{tag} {}", quoted(name)),
        }
    }
}
