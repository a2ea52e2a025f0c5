//! EDFs: what surfaces emit, as expressions.

use super::surface::Builder;
use crate::{
    error::Error,
    graph::{
        NodeRef,
        bind::{Node, is_built_in},
    },
    nodes::{Meaning, closures::Edf},
    program::{Expr, Geometry},
};

impl<'a> Builder<'a> {
    /// The radiance that an EDF input is connected to.
    pub(super) fn emission(&mut self, node: &Node<'a>, input: &str) -> Result<Option<Expr<'a>>, Error> {
        let Some(target) = node.connected(input) else { return Ok(None) };
        self.emission_of(target)
    }

    fn emission_of(&mut self, target: NodeRef<'a>) -> Result<Option<Expr<'a>>, Error> {
        self.enter(target)?;
        let radiance = if is_built_in(target.element) {
            let node = Node::bind(self.graph, target)?;
            let Meaning::Edf(edf) = node.def.meaning else {
                return Err(Error::NoGraph { at: target.element.place() });
            };
            self.edf(edf, &node)?
        } else {
            let inside = self.defined(target, None)?;
            self.emission_of(inside)?
        };
        self.leave();
        Ok(radiance)
    }

    /// `None` for an EDF that emits nothing.
    fn edf(&mut self, edf: Edf, node: &Node<'a>) -> Result<Option<Expr<'a>>, Error> {
        let sum = |a: Option<Expr<'a>>, b: Option<Expr<'a>>| match (a, b) {
            (Some(a), Some(b)) => Some(a + b),
            (a, b) => a.or(b),
        };
        Ok(match edf {
            Edf::Uniform => {
                let color = self.bounded(node, "color")?;
                (color.constant() != Some([0.0; 4])).then_some(color)
            }
            Edf::Add => sum(self.emission(node, "in1")?, self.emission(node, "in2")?),
            Edf::Multiply => {
                let factor = self.bounded(node, "in2")?;
                self.emission(node, "in1")?.map(|a| a * factor)
            }
            Edf::Mix => {
                let amount = self.bounded(node, "mix")?;
                let (fg, bg) = (self.emission(node, "fg")?, self.emission(node, "bg")?);
                sum(fg.map(|fg| fg * amount), bg.map(|bg| bg * (1.0 - amount)))
            }
            Edf::GeneralizedSchlick => self.schlick_edf(node)?,
        })
    }

    /// The base's radiance times `color0 + (color90 - color0) (1 - cos)^exponent`.
    fn schlick_edf(&mut self, node: &Node<'a>) -> Result<Option<Expr<'a>>, Error> {
        let Some(base) = self.emission(node, "base")? else { return Ok(None) };
        let (color0, color90) = (self.bounded(node, "color0")?, self.bounded(node, "color90")?);
        let exponent = self.bounded(node, "exponent")?;
        let [view, normal] =
            [Geometry::View, Geometry::Normal].map(|own| self.patterns.program.geometry(own));
        let share = (1.0 - view.dot(normal).abs()).max(0.0).power(exponent);
        Ok(Some(base * color0.mix(color90, share)))
    }
}
