//! Radiance: a material and the function file that its lobes are in.

use std::fmt::Write as _;

use super::law::ViewedLobe;
use crate::entrance::LEAST_COSINE;
use crate::mtlx::identifier;
use crate::significant;

/// Digits of the numbers that are written: more than single precision has.
const DIGITS: i32 = 9;

/// A material for Radiance: a `BRTDfunc` whose lobes are functions of a `.cal` file, and whose base is
/// diffuse.
///
/// Radiance turns a `BRTDfunc` towards whoever looks at it; a `mixfunc` makes its back black. The functions are
/// the node's formula (docs/theory.md, sections 2, 3 and 10) and not a table, so that what
/// `rtrace` finds is the lobe itself at any observation angle. They are evaluated for light sources:
/// Radiance's indirect light sees the diffuse base only.
#[derive(Clone, Copy, Debug)]
pub struct Radiance<'a> {
    /// Name of the material; letters and digits remain, the rest becomes `_`.
    pub name: &'a str,
    /// What both files say of themselves, a line each.
    pub remarks: &'a [String],
    /// The lobes.
    pub lobes: &'a [ViewedLobe],
    /// Albedo of the diffuse base, linear Rec. 709.
    pub base: [f64; 3],
}

impl Radiance<'_> {
    /// The material's primitive. `functions` is the name of the `.cal` file, which Radiance looks for in the
    /// folder that it runs in and along RAYPATH.
    #[must_use]
    pub fn material(&self, functions: &str) -> String {
        let mut text = String::new();
        for remark in self.remarks {
            // Writing to memory can't fail; the same below.
            writeln!(text, "# {}", remark.replace('\n', " ")).unwrap_or_default();
        }
        let [red, green, blue] = self.base.map(number);
        let name = identifier(self.name);
        text += &format!("void BRTDfunc {name}_front\n10 0 0 0 0 0 0 red green blue {functions}\n0\n");
        text += &format!("9 {red} {green} {blue} 0 0 0 0 0 0\n\n");
        text += &format!("void plastic {name}_back\n0\n0\n5 0 0 0 0 0\n\n");
        text + &format!("void mixfunc {name}\n4 {name}_front {name}_back front {functions}\n0\n0\n")
    }

    /// The function file.
    #[must_use]
    pub fn functions(&self) -> String {
        let remarks = self.remarks.join("\n  ").replace(['{', '}'], "");
        let mut text = format!("{{ {remarks} }}\n\n{GEOMETRY}");
        writeln!(text, "cv = max(co, {LEAST_COSINE});").unwrap_or_default();
        for (i, lobe) in (1..).zip(self.lobes) {
            text += &functions_of(i, lobe);
        }
        for (channel, name) in ["red", "green", "blue"].into_iter().enumerate() {
            let term =
                |(i, lobe): (usize, &ViewedLobe)| format!("{} * lobe{i}(x,y,z)", number(lobe.tint[channel]));
            let terms: Vec<String> = (1..).zip(self.lobes).map(term).collect();
            writeln!(text, "{name}(x,y,z,omega) = {};", terms.join(" + ")).unwrap_or_default();
        }
        text
    }
}

/// Two directions on the disk. Radiance's `Dx`, `Dy`, `Dz` is the ray from the viewer, `NxP`, `NyP`, `NzP`
/// the normal, and a function is called with the direction to the light. Exponentials below exp(-600) are 0,
/// as an underflow would be reported.
const GEOMETRY: &str = "\
{ 1 seen from the front }
front = if(Rdot, 1, 0);
{ cosines of the viewer and of the light }
co = -(Dx*NxP + Dy*NyP + Dz*NzP);
ci(x,y,z) = NxP*x + NyP*y + NzP*z;
max(a,b) : if(a-b, a, b);
min(a,b) : if(a-b, b, a);
sq(x) : x*x;
{ offset on the disk, times the sum of the cosines }
ox(x,y,z) = co*(x+Dx) + (ci(x,y,z)-co)*Dx;
oy(x,y,z) = co*(y+Dy) + (ci(x,y,z)-co)*Dy;
oz(x,y,z) = co*(z+Dz) + (ci(x,y,z)-co)*Dz;
{ squares of its length and of its part along the viewer's projection }
o2(x,y,z) = sq(ox(x,y,z)) + sq(oy(x,y,z)) + sq(oz(x,y,z));
u2(x,y,z) = min(o2(x,y,z), sq(ox(x,y,z)*(Dx+co*NxP) + oy(x,y,z)*(Dy+co*NyP) + oz(x,y,z)*(Dz+co*NzP))
    / max(1-sq(co), 1e-24));
power(base, exponent) : small(exponent*log(max(base, 1e-30)));
small(x) : if(x+600, exp(x), 0);
{ the lobe for both exponents plus 1, the squares, and the cosines }
lobe(eu, ev, u, o, c, i) = sqrt(eu*ev)/(2*PI) * power(1-o/sq(c+i), (eu*u + ev*(o-u))/max(o, 1e-36))
    * c/(sq(i)*(c+i)) * min(1, i/c)^3;
seen(eu, ev, x, y, z) = if(min(co, ci(x,y,z))-1e-9,
    lobe(eu, ev, u2(x,y,z), o2(x,y,z), co, ci(x,y,z)), 0);
";

/// The functions of a lobe: its strength, which the viewer's cosine `cv` determines, and the lobe itself.
fn functions_of(i: usize, lobe: &ViewedLobe) -> String {
    let law = &lobe.law;
    let [slope, bend, sharpness] = [law.slope, law.bend, law.sharpness].map(number);
    let strength = if law.is_power() {
        format!("cv^{slope}")
    } else {
        format!("(1 + (max(1/sq(cv)-1, 0)/{bend})^({sharpness}/2))^(-{slope}/{sharpness})")
    };
    let exponent = format!("2/sq({})", number(lobe.roughness));
    let (over, along) =
        if lobe.keeps_width { ("/cv", format!("{exponent}*sq(cv)")) } else { ("", exponent.clone()) };
    format!(
        "{{ lobe {i} }}\nstrength{i} = {strength}{over};\n\
         lobe{i}(x,y,z) = strength{i} * seen({along}+1, {exponent}+1, x, y, z);\n"
    )
}

fn number(x: f64) -> String {
    significant(x, DIGITS)
}
