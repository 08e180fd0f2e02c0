//! EXR: exact round trips, the header byte by byte, the same bytes always, damage refused.

use std::collections::BTreeMap;

use truecast::film::{Film, FilmError, Samples, decode_exr, encode_exr};

use super::{bits, specimen};

const FULL: [u32; 4] = [0, 0, 40, 37];
const CROP: [u32; 4] = [7, 5, 38, 30];

/// Attributes of a one-part EXR header, name to (type, value), and what follows the header.
struct ParsedHeader<'a> {
    attributes: BTreeMap<String, (String, &'a [u8])>,
    rest: &'a [u8],
}

/// Takes a zero-terminated text off the front.
fn take_text<'a>(bytes: &mut &'a [u8]) -> &'a str {
    let end = bytes.iter().position(|&byte| byte == 0).unwrap();
    let text = std::str::from_utf8(&bytes[..end]).unwrap();
    *bytes = &bytes[end + 1..];
    text
}

fn take<'a>(bytes: &mut &'a [u8], count: usize) -> &'a [u8] {
    let (taken, rest) = bytes.split_at(count);
    *bytes = rest;
    taken
}

fn integers(bytes: &[u8]) -> Vec<i32> {
    bytes.chunks_exact(4).map(|four| i32::from_le_bytes(four.try_into().unwrap())).collect()
}

/// Reads the header as the format's description lays it out.
fn parse_header(mut bytes: &[u8]) -> ParsedHeader<'_> {
    assert_eq!(take(&mut bytes, 4), [0x76, 0x2f, 0x31, 0x01], "magic number");
    assert_eq!(take(&mut bytes, 4), [2, 0, 0, 0], "version 2, one part, scan lines, short names");
    let mut attributes = BTreeMap::new();
    loop {
        let name = take_text(&mut bytes);
        if name.is_empty() {
            return ParsedHeader { attributes, rest: bytes };
        }
        let kind = take_text(&mut bytes);
        let size = integers(take(&mut bytes, 4))[0] as usize;
        let value = (kind.to_owned(), take(&mut bytes, size));
        assert!(attributes.insert(name.to_owned(), value).is_none(), "{name} is there twice");
    }
}

/// (name, type, sampling) of each channel; type 0 is UINT, 2 is FLOAT.
fn parse_channels(mut bytes: &[u8]) -> Vec<(String, i32, [i32; 2])> {
    let mut channels = Vec::new();
    loop {
        let name = take_text(&mut bytes);
        if name.is_empty() {
            return channels;
        }
        let fields = integers(take(&mut bytes, 16));
        channels.push((name.to_owned(), fields[0], [fields[2], fields[3]]));
    }
}

#[test]
fn the_header_says_what_the_film_is() {
    let film = specimen(CROP);
    let bytes = encode_exr(&film).unwrap();
    let ParsedHeader { attributes, rest } = parse_header(&bytes);

    let kinds: Vec<(&str, &str)> =
        attributes.iter().map(|(name, (kind, _))| (name.as_str(), kind.as_str())).collect();
    let expected = [
        ("channels", "chlist"),
        ("chromaticities", "chromaticities"),
        ("chunkCount", "int"),
        ("compression", "compression"),
        ("dataWindow", "box2i"),
        ("displayWindow", "box2i"),
        ("lineOrder", "lineOrder"),
        ("pixelAspectRatio", "float"),
        ("screenWindowCenter", "v2f"),
        ("screenWindowWidth", "float"),
        ("truecast", "string"),
        ("type", "string"),
    ];
    assert_eq!(kinds, expected);
    assert_eq!(attributes["compression"].1, [3], "ZIP in blocks of 16 rows");
    assert_eq!(attributes["lineOrder"].1, [0], "from the top down");
    assert_eq!(attributes["type"].1, b"scanlineimage");
    assert_eq!(attributes["truecast"].1, film.description.as_bytes());
    // Corners are inclusive in the file.
    assert_eq!(integers(attributes["displayWindow"].1), [0, 0, 39, 36]);
    assert_eq!(integers(attributes["dataWindow"].1), [7, 5, 37, 29]);

    let channels = parse_channels(attributes["channels"].1);
    let names = ["A", "B", "G", "N.X", "R", "Z", "bary.u", "cover", "id.prim", "u"];
    let expected = names.map(|name| {
        let kind = if matches!(name, "cover" | "id.prim") { 0 } else { 2 };
        (name.to_owned(), kind, [1, 1])
    });
    assert_eq!(channels, expected);

    // 25 rows are two blocks; the table's offsets lead to their first rows, in the file's order.
    let header_size = bytes.len() - rest.len();
    let mut last = header_size;
    for (block, first_row) in [(0, 5), (1, 21)] {
        let entry = header_size + 8 * block;
        let offset = u64::from_le_bytes(bytes[entry..entry + 8].try_into().unwrap()) as usize;
        assert!(offset > last);
        assert_eq!(integers(&bytes[offset..offset + 4]), [first_row]);
        last = offset;
    }
    let size = integers(&bytes[last + 4..last + 8])[0] as usize;
    assert_eq!(last + 8 + size, bytes.len(), "nothing follows the last block");
}

#[test]
fn every_bit_of_every_plane_comes_back() {
    for window in [FULL, CROP, [39, 36, 40, 37]] {
        let film = specimen(window);
        let back = decode_exr(&encode_exr(&film).unwrap()).unwrap();
        assert_eq!(back.resolution, film.resolution);
        assert_eq!(back.window, film.window);
        assert_eq!(back.description, film.description);
        assert_eq!(back.planes.len(), film.planes.len());
        for plane in &film.planes {
            let found = back.plane(&plane.name).unwrap();
            assert_eq!(
                matches!(found, Samples::Float(_)),
                matches!(plane.samples, Samples::Float(_))
            );
            assert_eq!(bits(found), bits(&plane.samples), "{}", plane.name);
        }
    }
}

#[test]
fn the_bytes_depend_on_neither_threads_nor_plane_order_nor_run() {
    let film = specimen(FULL);
    let reversed = Film { planes: film.planes.iter().rev().cloned().collect(), ..film.clone() };
    let reference = encode_exr(&film).unwrap();
    for threads in [1, 2, 3, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert!(pool.install(|| encode_exr(&film).unwrap()) == reference, "{threads} threads");
        assert!(pool.install(|| encode_exr(&reversed).unwrap()) == reference, "planes reversed");
    }
}

#[test]
fn damaged_bytes_are_refused_or_read_but_never_a_panic() {
    let film = specimen(CROP);
    let bytes = encode_exr(&film).unwrap();
    for end in (0..bytes.len()).step_by(7) {
        let error = decode_exr(&bytes[..end]).unwrap_err();
        assert!(matches!(error, FilmError::Decode { .. }), "cut at {end}: {error}");
    }
    for place in 0..bytes.len() {
        for flip in [0x01, 0x80, 0xff] {
            let mut damaged = bytes.clone();
            damaged[place] ^= flip;
            if let Ok(read) = decode_exr(&damaged) {
                let pixels = read.window.len();
                assert!(read.planes.iter().all(|plane| plane.samples.len() == pixels));
            }
        }
    }
}

#[test]
fn a_repeated_or_missing_block_is_refused() {
    let bytes = encode_exr(&specimen(CROP)).unwrap();
    let table = bytes.len() - parse_header(&bytes).rest.len();
    let second = u64::from_le_bytes(bytes[table + 8..table + 16].try_into().unwrap()) as usize;
    let mut repeated = bytes.clone();
    // The second block now says it holds the first one's rows.
    repeated[second..second + 4].copy_from_slice(&5_i32.to_le_bytes());
    assert!(decode_exr(&repeated).is_err());
}

#[test]
fn broken_films_are_refused() {
    let film = specimen(FULL);
    let mut short = film.clone();
    short.planes[1].samples = Samples::Uint(vec![0; 5]);
    let mut twice = film.clone();
    twice.planes[3].name = "R".to_owned();
    let mut nameless = film.clone();
    nameless.planes[0].name.clear();
    let mut endless = film.clone();
    endless.planes[0].name = "x".repeat(256);
    let empty = Film { planes: Vec::new(), ..film };
    for (broken, word) in [
        (short, "5 samples"),
        (twice, "two planes"),
        (nameless, "cannot name"),
        (endless, "cannot name"),
        (empty, "no plane"),
    ] {
        let error = encode_exr(&broken).unwrap_err();
        assert!(matches!(error, FilmError::Inconsistent { .. }));
        assert!(error.to_string().contains(word), "{error}");
    }
}

#[test]
fn half_samples_of_others_become_floats_and_tiles_are_refused() {
    use ::exr::prelude::{
        Encoding, Image, Layer, LayerAttributes, SpecificChannels, Vec2, WritableImage, f16,
    };
    let write = |encoding: Encoding| {
        let channels = SpecificChannels::build()
            .with_channel("Z")
            .with_pixel_fn(|Vec2(x, y)| (f16::from_bits((x * 700 + y) as u16),));
        let layer = Layer::new((30, 20), LayerAttributes::default(), encoding, channels);
        let mut bytes = std::io::Cursor::new(Vec::new());
        Image::from_layer(layer).write().to_buffered(&mut bytes).unwrap();
        bytes.into_inner()
    };
    let film = decode_exr(&write(Encoding::SMALL_LOSSLESS)).unwrap();
    let expected: Vec<f32> = film
        .window
        .pixels()
        .map(|at| f16::from_bits((at.x * 700 + at.y) as u16).to_f32())
        .collect();
    assert_eq!(film.window.len(), 600);
    assert_eq!(film.plane("Z"), Some(&Samples::Float(expected)));
    assert_eq!(film.description, "");

    let error = decode_exr(&write(Encoding::FAST_LOSSLESS)).unwrap_err().to_string();
    assert!(error.contains("tiled"), "{error}");
}
