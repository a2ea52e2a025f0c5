//! Radiance: a material and the function file that its lobes are in.

use std::fmt::Write as _;

use catseye::{BackVector, Lobe as _, Vec3};

use super::law::ViewedLobe;
use crate::entrance::LEAST_COSINE;
use crate::mtlx::identifier;
use crate::sheeting::fresnel;
use crate::significant;

/// Digits of the numbers that are written: more than single precision has.
const DIGITS: i32 = 9;

/// A clear coat over lobes and base: a dielectric surface, smooth or rough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coat {
    /// The share of the surface that has it, in `[0, 1]`.
    pub weight: f64,
    /// Index of refraction.
    pub ior: f64,
    /// GGX's alpha; 0 where it is smooth.
    pub alpha: f64,
}

/// The least alpha of a gloss that light sources are seen in; below it is a mirror.
const LEAST_ALPHA: f64 = 1e-3;

impl Coat {
    /// What passes to a viewer: as a layer in MaterialX, once, by the direction to the viewer.
    #[must_use]
    pub fn transmitted(&self, wo: Vec3<f64>) -> f64 {
        1.0 - self.weight * fresnel(wo.z, self.ior)
    }

    /// The BSDF of its gloss in 1/sr; 0 of a mirror.
    #[must_use]
    pub fn gloss(&self, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
        if self.is_mirror() {
            return 0.0;
        }
        // The back-vector lobe of the mirrored viewer is the usual one.
        let mirrored = Vec3::new(-wo.x, -wo.y, wo.z);
        let lobe = BackVector::new([self.alpha; 2], [1.0; 3]).map_or(0.0, |lobe| lobe.eval(mirrored, wi)[0]);
        self.weight * fresnel((0.5 * (1.0 + wo.dot(wi))).sqrt(), self.ior) * lobe
    }

    fn is_mirror(&self) -> bool {
        self.alpha < LEAST_ALPHA
    }

    /// Its functions: `through` to the viewer, `shade` as the base's pattern, `gloss` for light sources, and
    /// `mirror` for what is seen in it.
    fn functions(&self) -> String {
        let [weight, square, alpha] = [self.weight, self.ior * self.ior, self.alpha.powi(2)].map(number);
        let gloss = if self.is_mirror() {
            "gloss(x,y,z) = 0;\n".to_owned()
        } else {
            format!(
                "a2 : {alpha};\nvl(x,y,z) = -(Dx*x + Dy*y + Dz*z);\n\
                 ggx(h2) = a2/(PI*sq(h2*(a2-1)+1));\n\
                 smith(a,b) = a*sqrt(a2 + (1-a2)*sq(b));\n\
                 gloss(x,y,z) = if(min(co, ci(x,y,z))-1e-9, {weight}*fres(sqrt(max(1+vl(x,y,z), 0)/2))\n    \
                 * ggx(sq(co+ci(x,y,z))/(2+2*vl(x,y,z))) \
                 * 0.5/(smith(co, ci(x,y,z)) + smith(ci(x,y,z), co)), 0);\n"
            )
        };
        format!(
            "{{ clear coat }}\nn2 : {square};\n\
             split(c,g) = 0.5*(sq((c-g)/(c+g)) + sq((n2*c-g)/(n2*c+g)));\n\
             fres(c) = split(c, sqrt(max(n2-1+sq(c), 0)));\n\
             through = 1 - {weight}*fres(max(co, 0));\nshade = 1 - {weight}*fres(abs(Rdot));\n\
             mirror = {weight}*fres(abs(Rdot));\n{gloss}"
        )
    }
}

/// A material for Radiance: a `BRTDfunc` whose lobes are functions of a `.cal` file, and whose base is
/// diffuse.
///
/// Radiance turns a `BRTDfunc` towards whoever looks at it; a `mixfunc` makes its back black. The functions
/// are the node's formula (docs/theory.md, sections 2, 3 and 10) and not a table, so that what `rtrace` finds
/// is the lobe itself at any observation angle. They are evaluated for light sources: Radiance's indirect
/// light sees the diffuse base only.
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
    /// The coat over both, where there is one.
    pub coat: Option<Coat>,
}

impl Radiance<'_> {
    /// The BSDF in 1/sr per channel, without what is mirrored.
    #[must_use]
    pub fn eval(&self, wo: Vec3<f64>, wi: Vec3<f64>) -> [f64; 3] {
        let lobes = self.lobes.iter().map(|lobe| lobe.eval(wo, wi));
        let base = self.base.map(|base| base / std::f64::consts::PI);
        let below = lobes.fold(base, |sum, lobe| [0, 1, 2].map(|c| sum[c] + lobe[c]));
        match &self.coat {
            Some(coat) => below.map(|f| coat.transmitted(wo) * f + coat.gloss(wo, wi)),
            None => below,
        }
    }

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
        let mut pattern = "void".to_owned();
        if self.coat.is_some() {
            pattern = format!("{name}_coat");
            text += &format!("void brightfunc {pattern}\n2 shade {functions}\n0\n0\n\n");
        }
        let mirror = match self.coat {
            Some(coat) if coat.is_mirror() => "mirror mirror mirror",
            _ => "0 0 0",
        };
        text +=
            &format!("{pattern} BRTDfunc {name}_front\n10 {mirror} 0 0 0 red green blue {functions}\n0\n");
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
        text += &self.coat.map_or(String::new(), |coat| coat.functions());
        for (i, lobe) in (1..).zip(self.lobes) {
            text += &functions_of(i, lobe);
        }
        for (channel, name) in ["red", "green", "blue"].into_iter().enumerate() {
            let term =
                |(i, lobe): (usize, &ViewedLobe)| format!("{} * lobe{i}(x,y,z)", number(lobe.tint[channel]));
            let terms: Vec<String> = (1..).zip(self.lobes).map(term).collect();
            let sum = terms.join(" + ");
            let all = if self.coat.is_some() { format!("through*({sum}) + gloss(x,y,z)") } else { sum };
            writeln!(text, "{name}(x,y,z,omega) = {all};").unwrap_or_default();
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
    let strength = if law.is_power() && law.slope == 0.0 {
        "1".to_owned()
    } else if law.is_power() {
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
