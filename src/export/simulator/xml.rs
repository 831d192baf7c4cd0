//! XML as the writers of simulator files use it: indented, every name and text escaped by the library.

use std::io::{self, Cursor};

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};

/// A text that is being written.
pub(super) type Xml = Writer<Cursor<Vec<u8>>>;

/// Attributes of an element.
pub(super) type Attributes<'a> = &'a [(&'a str, &'a str)];

/// A document of one element.
pub(super) fn document(name: &str, attributes: Attributes, content: impl FnOnce(&mut Xml) -> io::Result<()>) -> io::Result<Vec<u8>> {
    let mut xml = Writer::new_with_indent(Cursor::new(Vec::new()), b' ', 2);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    within(&mut xml, name, attributes, content)?;
    let mut bytes = xml.into_inner().into_inner();
    bytes.push(b'\n');
    Ok(bytes)
}

/// An element with others in it.
pub(super) fn within(
    xml: &mut Xml,
    name: &str,
    attributes: Attributes,
    content: impl FnOnce(&mut Xml) -> io::Result<()>,
) -> io::Result<()> {
    xml.create_element(name).with_attributes(attributes.iter().copied()).write_inner_content(content)?;
    Ok(())
}

/// An element without content.
pub(super) fn empty(xml: &mut Xml, name: &str, attributes: Attributes) -> io::Result<()> {
    xml.create_element(name).with_attributes(attributes.iter().copied()).write_empty()?;
    Ok(())
}

/// An element with a text.
pub(super) fn text(xml: &mut Xml, name: &str, content: &str) -> io::Result<()> {
    attributed_text(xml, name, &[], content)
}

/// An element with attributes and a text.
pub(super) fn attributed_text(xml: &mut Xml, name: &str, attributes: Attributes, content: &str) -> io::Result<()> {
    // XML has no place for control characters, escaped or not.
    let content = content.replace(|c: char| c.is_control() && !['\n', '\r', '\t'].contains(&c), " ");
    xml.create_element(name).with_attributes(attributes.iter().copied()).write_text_content(BytesText::new(&content))?;
    Ok(())
}

/// A comment; what is written here is the program's own and has no two hyphens.
pub(super) fn comment(xml: &mut Xml, content: &str) -> io::Result<()> {
    xml.write_event(Event::Comment(BytesText::from_escaped(format!(" {content} "))))
}
