//! The classes of standards and the products whose values come with this crate.

use crate::{Error, Row, Table};

/// Where the values and their sources are: `data/README.md` says what is in them.
const STANDARDS: &str = include_str!("../data/standards.csv");
const PRODUCTS: &str = include_str!("../data/products.csv");
/// Names that an error lists at most.
const LISTED: usize = 12;

/// A class of a standard in one colour, or a product, with its values.
#[derive(Clone, Debug, PartialEq)]
pub struct StandardClass {
    id: String,
    table: Table,
    is_product: bool,
}

/// All classes.
#[derive(Clone, Debug, PartialEq)]
pub struct Catalogue {
    classes: Vec<StandardClass>,
}

impl StandardClass {
    /// A table of one's own as a class, whose id is the table's name; `None` for a table without rows.
    #[must_use]
    pub fn from_table(table: Table) -> Option<Self> {
        (!table.rows().is_empty()).then(|| Self { id: table.name().to_owned(), table, is_product: false })
    }

    /// The name, `standard:class:colour`: unique, in lower case, such as `fmvss108:dot-c2:white`.
    #[must_use]
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Whether the values are a product's, which are no class that others are asked to meet.
    #[must_use]
    pub fn is_product(&self) -> bool {
        self.is_product
    }

    /// The values, in the order of the standard; at least one. Its name is the id.
    #[must_use]
    pub fn table(&self) -> &Table {
        &self.table
    }

    /// The rows of [`StandardClass::table`].
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        self.table.rows()
    }

    /// The name for people, such as `FMVSS 108 Grade DOT-C2 white`; the id where the table has no words.
    #[must_use]
    pub fn title(&self) -> String {
        let [standard, class, colour] = self.words();
        // What follows a comma is of a single row: a position, a condition.
        let class = class.split(", ").next().unwrap_or_default();
        let words = [standard, class, colour].into_iter().filter(|word| !word.is_empty());
        let title = words.collect::<Vec<_>>().join(" ");
        if title.is_empty() { self.id.clone() } else { title }
    }

    /// Standard, class and colour of the id.
    fn parts(&self) -> [&str; 3] {
        let mut parts = self.id.splitn(3, ':');
        std::array::from_fn(|_| parts.next().unwrap_or_default())
    }

    /// The same in the words of the standard.
    fn words(&self) -> [&str; 3] {
        self.rows()[0].words()
    }
}

impl Catalogue {
    /// The classes and products that come with this crate.
    ///
    /// # Errors
    /// None: a test reads the tables. They are checked like everyone's.
    pub fn embedded() -> Result<Self, Error> {
        let mut classes = classes_of(STANDARDS, "standards.csv", false)?;
        classes.extend(classes_of(PRODUCTS, "products.csv", true)?);
        Ok(Self { classes })
    }

    /// Every class, those of a standard together; then the products.
    #[must_use]
    pub fn classes(&self) -> &[StandardClass] {
        &self.classes
    }

    /// The one class of that name.
    ///
    /// # Errors
    /// A name that fits no class or several; the error lists what it could be.
    pub fn find(&self, name: &str) -> Result<&StandardClass, Error> {
        match self.matching(name)?[..] {
            [class] => Ok(class),
            ref several => Err(Error::AmbiguousStandard { name: name.to_owned(), candidates: ids(several) }),
        }
    }

    /// The classes whose name begins with `name`, a `STANDARD[:CLASS[:COLOUR]]`.
    ///
    /// Case, spaces and signs don't matter, and the standard's own words will do:
    /// `FMVSS 108:Grade DOT-C2:white`. Of a part that names nothing exactly the beginning is enough, or any
    /// piece of it: `d4956:ii` is `astm-d4956:ii`. The second part may be the colour, and the class be joined
    /// to the standard: `3m-8830`.
    ///
    /// # Errors
    /// A name that fits no class.
    pub fn matching(&self, name: &str) -> Result<Vec<&StandardClass>, Error> {
        let parts: Vec<String> = name.split(':').map(plain).collect();
        let all: Vec<&StandardClass> = self.classes.iter().collect();
        let unknown =
            |among: &[&StandardClass]| Error::UnknownStandard { name: name.to_owned(), known: ids(among) };
        if parts.len() > 3 || parts[0].is_empty() {
            return Err(unknown(&all));
        }
        let joined = |class: &&StandardClass| plain(&class.parts()[..2].concat()) == parts[0];
        let of_standard = narrowed(&all, &parts[0], 0);
        if of_standard.is_empty() {
            let joined: Vec<&StandardClass> = all.iter().copied().filter(joined).collect();
            return if parts.len() == 1 && !joined.is_empty() { Ok(joined) } else { Err(unknown(&all)) };
        }
        let Some(second) = parts.get(1) else { return Ok(of_standard) };
        let mut found = narrowed(&of_standard, second, 1);
        if found.is_empty() && parts.len() == 2 {
            found = narrowed(&of_standard, second, 2);
        }
        if found.is_empty() {
            return Err(unknown(&of_standard));
        }
        let Some(third) = parts.get(2) else { return Ok(found) };
        let of_colour = narrowed(&found, third, 2);
        if of_colour.is_empty() { Err(unknown(&found)) } else { Ok(of_colour) }
    }
}

/// The classes of an embedded table.
fn classes_of(text: &str, name: &str, is_product: bool) -> Result<Vec<StandardClass>, Error> {
    let table = Table::parse_values(text.as_bytes(), name)?;
    let mut ids: Vec<&str> = Vec::new();
    for row in table.rows() {
        if !ids.contains(&id_of(row)) {
            ids.push(id_of(row));
        }
    }
    let class = |id: &str| {
        let rows = table.rows().iter().filter(|row| id_of(row) == id).cloned().collect();
        StandardClass { id: id.to_owned(), table: Table::from_rows(id, table.header(), rows), is_product }
    };
    Ok(ids.into_iter().map(class).collect())
}

/// The classes whose part `i` is `text`, else begins with it, else contains it.
fn narrowed<'a>(classes: &[&'a StandardClass], text: &str, i: usize) -> Vec<&'a StandardClass> {
    let fits: [fn(&str, &str) -> bool; 3] =
        [|part, text| part == text, |part, text| part.starts_with(text), |part, text| part.contains(text)];
    let found = |fits: fn(&str, &str) -> bool| -> Vec<&'a StandardClass> {
        let is_it = |class: &&StandardClass| {
            [class.parts()[i], class.words()[i]].into_iter().any(|part| fits(&plain(part), text))
        };
        classes.iter().copied().filter(is_it).collect()
    };
    fits.into_iter().map(found).find(|found| !found.is_empty()).unwrap_or_default()
}

/// Letters and digits alone, in lower case.
pub(crate) fn plain(text: &str) -> String {
    text.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// The id is the first column of the embedded table.
fn id_of(row: &Row) -> &str {
    row.cells.first().map_or("", String::as_str)
}

/// Names for an error: of many classes the beginnings that tell them apart, the shortest that do.
fn ids(classes: &[&StandardClass]) -> String {
    let names = |parts: usize| {
        let mut names: Vec<String> = classes.iter().map(|class| class.parts()[..parts].join(":")).collect();
        names.dedup();
        names
    };
    let full = names(3);
    let several = [1, 2].map(names).into_iter().find(|names| names.len() > 1);
    let listed = if full.len() > LISTED { several.unwrap_or(full) } else { full };
    listed.join(", ")
}
