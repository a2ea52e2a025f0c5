//! Taking the picture: tiles, threads, samples.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::Vec3;
use rayon::prelude::*;

use crate::sampler::Sampler;
use crate::integrator::{self, Plan};
use crate::{Error, Filter, Image, Scene};

/// Side of the squares of pixels that threads work on.
const TILE: usize = 16;
/// The longest side of a picture: a square of it is 3 GiB of pixels.
const MAX_SIZE: usize = 1 << 14;

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
    fn validate(&self) -> Result<(), Error> {
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
    let Some(threads) = settings.threads else { return Ok(render_tiles(scene, settings, progress)) };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|e| Error::Threads { threads, reason: e.to_string() })?;
    Ok(pool.install(|| render_tiles(scene, settings, progress)))
}

fn render_tiles(scene: &Scene, settings: &RenderSettings, progress: &(dyn Fn(f32) + Sync)) -> Image {
    let columns = settings.width.div_ceil(TILE);
    let count = columns * settings.height.div_ceil(TILE);
    let done = AtomicUsize::new(0);
    let plan = Plan::of(scene, settings);
    let tiles: Vec<Image> = (0..count)
        .into_par_iter()
        .with_max_len(1)
        .map(|i| {
            let tile = render_tile(scene, settings, plan, [i % columns * TILE, i / columns * TILE]);
            progress((done.fetch_add(1, Ordering::Relaxed) + 1) as f32 / count as f32);
            tile
        })
        .collect();
    let mut image = Image::new(settings.width, settings.height);
    for (i, tile) in tiles.iter().enumerate() {
        image.paste(tile, i % columns * TILE, i / columns * TILE);
    }
    image
}

fn render_tile(scene: &Scene, settings: &RenderSettings, plan: Plan, [left, top]: [usize; 2]) -> Image {
    let (width, height) = (TILE.min(settings.width - left), TILE.min(settings.height - top));
    Image::from_fn(width, height, |x, y| render_pixel(scene, settings, plan, [left + x, top + y]))
}

fn render_pixel(scene: &Scene, settings: &RenderSettings, plan: Plan, pixel: [usize; 2]) -> [f32; 3] {
    let size = [settings.width as f32, settings.height as f32];
    let mut sum = Vec3::ZERO;
    for index in 0..settings.spp {
        let mut sampler = Sampler::new(pixel.map(|p| p as u32), index, settings.seed);
        let [u, v, ..] = sampler.next_4d();
        let position = [
            pixel[0] as f32 + 0.5 + settings.filter.sample(u),
            pixel[1] as f32 + 0.5 + settings.filter.sample(v),
        ];
        let ray = scene.camera().ray(position, size);
        sum += integrator::radiance(scene, ray, &mut sampler, plan);
    }
    (sum / settings.spp as f32).into()
}
