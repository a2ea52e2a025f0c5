//! EXR: the first flat layer at its full resolution, block by block.

use exr::{
    block::{self, UncompressedBlock, reader::ChunksReader as _},
    math::Vec2,
    meta::{
        attribute::{ChannelDescription, SampleType},
        header::Header,
    },
    prelude::{Error, f16},
};

use super::{Depth, Layout, Picture, Refusal, Room, Source, check_size, unsupported};

/// Blocks of a file, of all layers and resolutions.
const MAX_BLOCKS: usize = 1 << 20;
/// Channels of a layer.
const MAX_CHANNELS: usize = 256;

pub(super) fn decode(source: Source, room: &mut Room) -> Result<Picture, Refusal> {
    let reader = block::read(source, false)?;
    let layer = reader.headers().iter().position(|header| !header.deep);
    let Some(layer) = layer else { return unsupported("deep data", "a flat picture") };
    let header = reader.headers()[layer].clone();
    let size = header.layer_size;
    check_size(size.width(), size.height())?;
    let blocks = reader.headers().iter().map(|header| header.chunk_count);
    if blocks.fold(0, usize::saturating_add) > MAX_BLOCKS || header.channels.list.len() > MAX_CHANNELS {
        return Err(Refusal::Room);
    }
    let slots = slots(&header)?;
    // A block as it is stored, as it is, and once more for the compressions that reorder it; and the table of
    // blocks.
    room.scratch(header.max_block_byte_size().saturating_mul(3).saturating_add(16 * MAX_BLOCKS))?;
    let channels = slots.iter().flatten().max().map_or(1, |most| most + 1);
    let is_half = |(slot, channel): (&Option<usize>, &ChannelDescription)| {
        slot.is_none() || channel.sample_type == SampleType::F16
    };
    let all_half = slots.iter().zip(&header.channels.list).all(is_half);
    let depth = if all_half { Depth::Half } else { Depth::Float };
    let mut picture = room.picture(Layout { width: size.width(), height: size.height(), channels, depth })?;
    let wanted = |_: &_, _, block: block::BlockIndex| block.layer == layer && block.level == Vec2(0, 0);
    let mut blocks = reader.filter_chunks(false, wanted)?.sequential_decompressor(false);
    let mut pixels = 0;
    while let Some(block) = blocks.decompress_next_block() {
        let block = block?;
        pixels += block.index.pixel_size.area();
        place(&block, &header, &slots, &mut picture)?;
    }
    if pixels == size.area() { Ok(picture) } else { Err(Refusal::Damaged) }
}

/// Which channel of the picture each channel of the file is, if any.
fn slots(header: &Header) -> Result<Vec<Option<usize>>, Refusal> {
    let names: Vec<String> = header.channels.list.iter().map(|channel| channel.name.to_string()).collect();
    // The channels without a layer's name, else those of the first layer.
    let layer = if names.iter().any(|name| !name.contains('.')) { "" } else { prefix(&names[0]) };
    let of_layer = |name: &&String| prefix(name) == layer;
    let own = |name: &String| if prefix(name) == layer { Some(name[layer.len()..].to_owned()) } else { None };
    let has = |wanted: &str| names.iter().any(|name| own(name).as_deref() == Some(wanted));
    if has("RY") || has("BY") {
        return unsupported("luminance with subsampled chroma (Y, RY, BY)", "one with R, G, B");
    }
    let channels: &[&str] = match (has("R") || has("G") || has("B"), has("Y")) {
        // A picture of one channel, whatever its name.
        _ if names.iter().filter(of_layer).count() == 1 => &[],
        (true, _) => &["R", "G", "B", "A"],
        (false, true) => &["Y", "A"],
        _ => return unsupported("an EXR without the channels R, G, B or Y", "one that has them"),
    };
    let slot = |name: &String| {
        let own = own(name)?;
        if channels.is_empty() { Some(0) } else { channels.iter().position(|channel| *channel == own) }
    };
    let slots: Vec<Option<usize>> = names.iter().map(slot).collect();
    let subsampled = |(slot, channel): (&Option<usize>, &ChannelDescription)| {
        slot.is_some() && channel.sampling != Vec2(1, 1)
    };
    if slots.iter().zip(&header.channels.list).any(subsampled) {
        return unsupported("a subsampled channel", "one in full resolution");
    }
    Ok(slots)
}

/// The layer's name in front of a channel's, with the dot.
fn prefix(name: &str) -> &str {
    name.rfind('.').map_or("", |dot| &name[..=dot])
}

/// Copies a block's lines to their places.
fn place(
    block: &UncompressedBlock,
    header: &Header,
    slots: &[Option<usize>],
    picture: &mut Picture,
) -> Result<(), Refusal> {
    let Layout { width, height, channels, depth } = picture.layout;
    let pixel = channels * depth.bytes();
    for line in block.lines(&header.channels) {
        let Some(slot) = slots[line.location.channel] else { continue };
        let Vec2(column, row) = line.location.position;
        if row >= height || column + line.location.sample_count > width {
            return Err(Refusal::Damaged);
        }
        let pixels = picture.row(row).chunks_exact_mut(pixel).skip(column);
        let kind = header.channels.list[line.location.channel].sample_type;
        let numbers = line.value.chunks_exact(kind.bytes_per_sample());
        for (pixel, number) in pixels.zip(numbers) {
            let place = &mut pixel[slot * depth.bytes()..][..depth.bytes()];
            match (kind, depth, number) {
                (SampleType::F16, Depth::Float, &[a, b]) => {
                    place.copy_from_slice(&f16::from_ne_bytes([a, b]).to_f32().to_ne_bytes());
                }
                (SampleType::U32, _, &[a, b, c, d]) => {
                    place.copy_from_slice(&(u32::from_ne_bytes([a, b, c, d]) as f32).to_ne_bytes());
                }
                _ => place.copy_from_slice(number),
            }
        }
    }
    Ok(())
}

impl From<Error> for Refusal {
    fn from(cause: Error) -> Self {
        match cause {
            Error::Io(cause) => cause.into(),
            Error::NotSupported(what) => Self::Unsupported {
                what: format!("this kind of EXR ({what})"),
                instead: "a flat one with ZIP or PIZ",
            },
            _ => Self::Damaged,
        }
    }
}
