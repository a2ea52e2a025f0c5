//! A material fitted to a measured BRDF: lobes around the incident direction, the base where it is seen
//! alone, a coat where there is a mirror peak, and how good each of them is.

use super::coat::Coat;
use super::selection::rows;
use super::{Brdf, BrdfSample, Metrics, Region, Selection, metrics};
use crate::fit::{Fit, FitError, FitOptions, Observation, fit};
use crate::sheeting::{PreparedSheeting, Surface};
use crate::{ApertureRule, Apertures, Error};

/// Degree of the aperture's rule: a BRDF's samples are many, and its lobes wide beside any sensible aperture.
const DEGREE: usize = 7;
/// The greatest part of a value that is taken off it for the coat.
const MOST_OF_COAT: f64 = 0.5;

/// A part of the file and how good the model is there.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Which part.
    pub region: Region,
    /// Where it is, in words.
    pub name: String,
    /// Over all samples of the part.
    pub metrics: Metrics,
}

/// A fit to a measured BRDF.
#[derive(Clone, Debug)]
pub struct BrdfFit {
    /// The material; it is acceptable where it is physical and its errors around the incident direction are
    /// within the tolerance ([`Metrics::is_within`]). Worst error and root mean square are those of all
    /// samples there.
    pub fit: Fit,
    /// What lobes and base were fitted to: samples around the incident direction and away from both peaks,
    /// less what a coat reflects.
    pub observations: Vec<Observation>,
    /// The parts, those without samples left out.
    pub parts: Vec<Part>,
}

/// Why a measured BRDF has no fit.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BrdfFitError {
    /// Apertures out of range.
    #[error(transparent)]
    Apertures(#[from] Error),
    /// The samples or the options.
    #[error(transparent)]
    Fit(#[from] FitError),
}

impl Brdf {
    /// Fits lobes, base and coat. With `coat_ior` the coat has that index, else the one of the mirror peak.
    ///
    /// # Errors
    /// Apertures and options out of range, samples that determine nothing.
    pub fn fit(
        &self,
        selection: &Selection,
        apertures: Apertures,
        options: &FitOptions,
    ) -> Result<BrdfFit, BrdfFitError> {
        let coat = self.coat(selection, apertures, options.coat_ior)?;
        let rule = apertures.rule_of_degree(DEGREE)?;
        let retro = without_coat(rows(selection.of(self), &rule), coat);
        if retro.is_empty() {
            return Err(FitError::NotRetro.into());
        }
        let base = without_coat(rows(selection.of_base(self), &rule), coat);
        let mut warnings = Vec::new();
        if base.is_empty() {
            warnings.push(
                "no sample is 30 deg away from both the incident and the mirror direction: the base is \
                 what the lobes leave"
                    .to_owned(),
            );
        }
        let observations = [retro, base].concat();
        let options = FitOptions { coat_ior: coat.map(|coat| coat.ior).or(options.coat_ior), ..*options };
        let mut fit = fit(&observations, &options)?;
        fit.sheeting.coat_roughness = coat.map_or(0.0, |coat| coat.roughness);
        let parts = self.parts(selection, &rule, &fit)?;
        if let Some(Part { metrics, .. }) = parts.iter().find(|part| part.region == Region::Retro) {
            (fit.worst, fit.rms) = (metrics.worst(), metrics.log_rmse);
            fit.acceptable = fit.fault.is_none() && metrics.is_within(options.tolerance);
        }
        fit.warnings.extend(warnings);
        let left_out = parts.iter().filter(|part| part.is_left_out(options.tolerance));
        fit.warnings.extend(left_out.map(Part::warning));
        Ok(BrdfFit { fit, observations, parts })
    }

    /// How good a model is in each region.
    fn parts(&self, selection: &Selection, rule: &ApertureRule, fit: &Fit) -> Result<Vec<Part>, FitError> {
        let prepared = fit.sheeting.prepare().map_err(|_| FitError::NoSolution)?;
        let part = |region: Region| {
            let pair = |sample: &BrdfSample| (seen(&prepared, rule, sample), sample.luminance());
            let metrics = metrics(selection.samples(self, region).map(pair))?;
            Some(Part { region, name: region.name(selection), metrics })
        };
        Ok(Region::ALL.into_iter().filter_map(part).collect())
    }
}

/// What an instrument sees of a material.
fn seen(prepared: &PreparedSheeting<'_>, rule: &ApertureRule, sample: &BrdfSample) -> f64 {
    rule.mean(sample.wo, sample.wi, |wo, wi| prepared.eval_with_surface(wo, wi))
}

/// The rows less what a coat reflects there; without those that are mostly that.
fn without_coat(rows: Vec<Observation>, coat: Option<Coat>) -> Vec<Observation> {
    let surface = coat.and_then(|Coat { ior, roughness }| Surface::new(ior, roughness).ok());
    let Some(surface) = surface else { return rows };
    let less = |row: Observation| {
        let reflected = surface.mean(&row);
        let value = row.value - reflected;
        (reflected < MOST_OF_COAT * row.value).then_some(Observation { value, ..row })
    };
    rows.into_iter().filter_map(less).collect()
}

impl Part {
    /// Whether the model isn't one of this part, which nobody asked of it.
    fn is_left_out(&self, tolerance: f64) -> bool {
        let judged_otherwise = matches!(self.region, Region::Retro | Region::File);
        !judged_otherwise && !self.metrics.is_within(tolerance)
    }

    fn warning(&self) -> String {
        let what = if self.region == Region::Mirror { "the mirror peak" } else { "the base" };
        format!("{what} is not met: {}, log-RMSE {:.2}", self.name, self.metrics.log_rmse)
    }
}
