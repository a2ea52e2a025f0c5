//! Taking the picture: tiles, threads, samples.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::film::Sum;
use crate::integrator::{self, Plan};
use crate::sampler::Sampler;
use crate::{Error, Film, Filter, Image, Region, Scene};

/// Side of the squares of pixels that threads work on.
const TILE: usize = 16;
/// The longest side of a picture: a square of it is 3 GiB of pixels.
pub(crate) const MAX_SIZE: usize = 1 << 14;

/// How a picture is taken.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// Columns, 1 to 16384.
    pub width: usize,
    /// Rows, 1 to 16384.
    pub height: usize,
    /// Samples for each pixel, at least 1. Powers of two use the sampling pattern best.
    pub spp: u32,
    /// Scatterings of a path: 1 is direct light only, 0 shows nothing but lights.
    pub max_depth: u32,
    /// Another seed gives other noise.
    pub seed: u32,
    /// Worker threads; `None` takes as many as there are cores. The picture is the same to the last bit.
    pub threads: Option<usize>,
    /// How samples are spread around a pixel's centre.
    pub filter: Filter,
}

impl Default for RenderSettings {
    /// 960 x 540, 16 samples, 6 scatterings: the size that the built-in scene is made for.
    fn default() -> Self {
        Self {
            width: 960,
            height: 540,
            spp: 16,
            max_depth: 6,
            seed: 0,
            threads: None,
            filter: Filter::default(),
        }
    }
}

impl RenderSettings {
    pub(crate) fn validate(&self) -> Result<(), Error> {
        let range = "1 to 16384";
        for (name, value) in [("width", self.width), ("height", self.height)] {
            if value == 0 || value > MAX_SIZE {
                return Err(Error::Setting { name, value: value as u64, range });
            }
        }
        if self.spp == 0 {
            return Err(Error::Setting { name: "spp", value: 0, range: "1 and above" });
        }
        if self.threads == Some(0) {
            return Err(Error::Setting { name: "threads", value: 0, range: "1 and above" });
        }
        Ok(())
    }
}

/// Takes a picture of the scene: linear radiance.
///
/// `progress` is called from the worker threads, with the share of the work that is done, in `(0, 1]` and not
/// necessarily in rising order. The picture depends on the scene and the settings only, not on the number of
/// threads.
///
/// # Errors
/// A setting out of its range, or threads that can't be started.
pub fn render(
    scene: &Scene,
    settings: &RenderSettings,
    progress: &(dyn Fn(f32) + Sync),
) -> Result<Image, Error> {
    settings.validate()?;
    let region = Region { start: [0; 2], end: [settings.width, settings.height] };
    let never = AtomicBool::new(false);
    let plan = Plan::of(scene, settings);
    let samples = 0..settings.spp;
    // A pixel's sum takes four times the room of its mean.
    let render = |tile| -> Vec<_> {
        let sums = render_tile(scene, settings, plan, tile, &samples);
        sums.into_iter().map(|sum| sum.mean(settings.spp)).collect()
    };
    let mut image = Image::new(settings.width, settings.height);
    let tiles = in_threads(settings, || in_tiles(region, &never, progress, render))?;
    for (tile, pixels) in tiles.unwrap_or_default() {
        let [width, height] = tile.size();
        let pixels = Image::from_fn(width, height, |x, y| pixels[y * width + x]);
        image.paste(&pixels, tile.start[0], tile.start[1]);
    }
    Ok(image)
}

/// Adds the next `count` samples of each of its pixels to a film; of the settings `spp` is not used. False,
/// and the film as it was, where `stop` became true first.
///
/// # Errors
/// As [`render`], and a film of another picture.
pub fn expose(
    scene: &Scene,
    settings: &RenderSettings,
    film: &mut Film,
    count: u32,
    stop: &AtomicBool,
    progress: &(dyn Fn(f32) + Sync),
) -> Result<bool, Error> {
    settings.validate()?;
    let start = film.samples.end;
    let samples = start..start.saturating_add(count);
    let plan = Plan::of(scene, settings);
    let render = |tile| render_tile(scene, settings, plan, tile, &samples);
    let tiles = in_threads(settings, || in_tiles(film.region, stop, progress, render))?;
    let Some(tiles) = tiles else { return Ok(false) };
    let [columns, _] = film.region.size();
    for (tile, sums) in tiles {
        let [width, _] = tile.size();
        for (row, sums) in sums.chunks(width).enumerate() {
            let at =
                (tile.start[1] - film.region.start[1] + row) * columns + tile.start[0] - film.region.start[0];
            film.sums[at..].iter_mut().zip(sums).for_each(|(sum, more)| sum.merge(*more));
        }
    }
    film.samples.end = samples.end;
    Ok(true)
}

/// Runs work on the threads that the settings ask for.
fn in_threads<T: Send>(settings: &RenderSettings, work: impl FnOnce() -> T + Send) -> Result<T, Error> {
    let Some(threads) = settings.threads else { return Ok(work()) };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|e| Error::Threads { threads, reason: e.to_string() })?;
    Ok(pool.install(work))
}

/// Does the work for all tiles of a region; `None` where `stop` became true first.
fn in_tiles<T: Send>(
    region: Region,
    stop: &AtomicBool,
    progress: &(dyn Fn(f32) + Sync),
    work: impl Fn(Region) -> T + Sync,
) -> Option<Vec<(Region, T)>> {
    let [columns, rows] = region.size().map(|length| length.div_ceil(TILE));
    let count = columns * rows;
    let done = AtomicUsize::new(0);
    let tile = |i: usize| {
        if stop.load(Ordering::Relaxed) {
            return None;
        }
        let place = [i % columns, i / columns];
        let start = [0, 1].map(|axis| region.start[axis] + place[axis] * TILE);
        let end = [0, 1].map(|axis| region.end[axis].min(start[axis] + TILE));
        let tile = Region { start, end };
        let result = work(tile);
        progress((done.fetch_add(1, Ordering::Relaxed) + 1) as f32 / count as f32);
        Some((tile, result))
    };
    (0..count).into_par_iter().with_max_len(1).map(tile).collect()
}

fn render_tile(
    scene: &Scene,
    settings: &RenderSettings,
    plan: Plan,
    tile: Region,
    samples: &Range<u32>,
) -> Vec<Sum> {
    let [width, _] = tile.size();
    let pixel = |i: usize| [tile.start[0] + i % width, tile.start[1] + i / width];
    (0..tile.pixels()).map(|i| render_pixel(scene, settings, plan, pixel(i), samples.clone())).collect()
}

fn render_pixel(
    scene: &Scene,
    settings: &RenderSettings,
    plan: Plan,
    pixel: [usize; 2],
    samples: Range<u32>,
) -> Sum {
    let size = [settings.width as f32, settings.height as f32];
    let mut sum = Sum::default();
    for index in samples {
        let mut sampler = Sampler::new(pixel.map(|p| p as u32), index, settings.seed);
        let [u, v, ..] = sampler.next_4d();
        let position = [
            pixel[0] as f32 + 0.5 + settings.filter.sample(u),
            pixel[1] as f32 + 0.5 + settings.filter.sample(v),
        ];
        let ray = scene.camera().ray(position, size);
        sum.add(integrator::radiance(scene, ray, &mut sampler, plan).into());
    }
    sum
}
