//! Ids and depths in every format that others write.

use npyz::WriterBuilder;
use std::path::PathBuf;
use tempfile::TempDir;
use truecast::film::{
    Film, NumberPlane, Numbers, PackedOrder, Plane, Samples, encode_exr, load_numbers,
};
use truecast::pixel::Resolution;

const IDS: [u32; 6] = [0, 1, 70_000, 3, 16_777_214, 5];

fn written(name: &str, bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    (folder, path)
}

fn load(name: &str, bytes: &[u8], order: PackedOrder) -> Result<NumberPlane, String> {
    let (_folder, path) = written(name, bytes);
    load_numbers(&path, order, |film| Ok(film.planes[0].name.clone()))
        .map_err(|error| error.to_string())
}

fn npy<T: npyz::Serialize + Copy>(
    kind: &str,
    shape: &[u64],
    order: npyz::Order,
    values: &[T],
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let kind: npyz::TypeStr = kind.parse().unwrap();
    let mut writer = npyz::WriteOptions::<T>::new()
        .dtype(npyz::DType::Plain(kind))
        .shape(shape)
        .order(order)
        .writer(&mut bytes)
        .begin_nd()
        .unwrap();
    writer.extend(values.iter().copied()).unwrap();
    writer.finish().unwrap();
    bytes
}

fn png(kind: png::ColorType, depth: png::BitDepth, codes: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 3, 2);
    encoder.set_color(kind);
    encoder.set_depth(depth);
    encoder.write_header().unwrap().write_image_data(codes).unwrap();
    bytes
}

fn whole(plane: &NumberPlane) -> Vec<i64> {
    assert_eq!((plane.frame.width(), plane.frame.height()), (3, 2));
    match &plane.numbers {
        Numbers::Whole(values) => values.clone(),
        Numbers::Float(values) => values.iter().map(|&value| value as i64).collect(),
    }
}

#[test]
fn npy_of_every_type_and_order_is_read() {
    let c = npyz::Order::C;
    let ids = IDS.map(i64::from).to_vec();
    let read = |bytes: &[u8]| whole(&load("a.npy", bytes, PackedOrder::RedFirst).unwrap());
    assert_eq!(read(&npy("<u4", &[2, 3], c, &IDS)), ids);
    assert_eq!(read(&npy(">u4", &[2, 3], c, &IDS)), ids);
    assert_eq!(read(&npy("<u4", &[2, 3, 1], c, &IDS)), ids);
    assert_eq!(read(&npy("<i4", &[2, 3], c, &IDS.map(|v| v as i32))), ids);
    assert_eq!(read(&npy("<u8", &[2, 3], c, &IDS.map(u64::from))), ids);
    assert_eq!(read(&npy("<i8", &[2, 3], c, &IDS.map(i64::from))), ids);
    assert_eq!(read(&npy("<f4", &[2, 3], c, &IDS.map(|v| v as f32))), ids);
    assert_eq!(read(&npy("<f8", &[2, 3], c, &IDS.map(f64::from))), ids);
    let small = [0_u8, 1, 2, 3, 4, 255];
    assert_eq!(read(&npy("|u1", &[2, 3], c, &small)), small.map(i64::from));
    assert_eq!(read(&npy("<u2", &[2, 3], c, &small.map(u16::from))), small.map(i64::from));
    assert_eq!(read(&npy("<u8", &[2, 3], c, &[u64::MAX; 6])), [-1; 6]);
    // By columns: the same picture, laid down column after column.
    let columns = [0, 3, 1, 4, 2, 5].map(|i: usize| IDS[i]);
    assert_eq!(read(&npy("<u4", &[2, 3], npyz::Order::Fortran, &columns)), ids);
}

#[test]
fn what_cannot_be_read_says_why() {
    let c = npyz::Order::C;
    let refused = |name: &str, bytes: &[u8], word: &str| {
        let error = load(name, bytes, PackedOrder::RedFirst).unwrap_err();
        assert!(error.contains(word) && error.contains(name), "{word:?}: {error}");
    };
    refused("a.npy", &npy("<u4", &[6], c, &IDS), "(height, width)");
    let short = npy("<u4", &[2, 3], c, &IDS);
    refused("a.npy", &short[..short.len() - 5], "");
    refused("a.npy", b"nothing of the kind", "");
    refused("a.png", b"nothing of the kind", "");
    refused("a.exr", b"nothing of the kind", "");
    refused("a.tif", b"", ".npy, .png or .exr");
    refused("a.png", &png(png::ColorType::Rgb, png::BitDepth::Sixteen, &[0; 36]), "8-bit RGB");
    // A header that promises far more than is there.
    let header = "{'descr': '<u4', 'fortran_order': False, 'shape': (60000, 60000), }\n";
    let length = u8::try_from(header.len()).unwrap();
    let huge = [b"\x93NUMPY\x01\x00", &[length, 0][..], header.as_bytes()].concat();
    refused("a.npy", &huge, "shorter");
}

#[test]
fn packed_and_grey_pngs_are_read() {
    use png::{BitDepth, ColorType};
    let ids = IDS.map(i64::from).to_vec();
    let bytes = |f: fn([u8; 4]) -> Vec<u8>| -> Vec<u8> {
        IDS.iter().flat_map(|id| f(id.to_be_bytes())).collect()
    };
    let rgb = png(ColorType::Rgb, BitDepth::Eight, &bytes(|[_, r, g, b]| vec![r, g, b]));
    let bgr = png(ColorType::Rgb, BitDepth::Eight, &bytes(|[_, r, g, b]| vec![b, g, r]));
    let rgba = png(ColorType::Rgba, BitDepth::Eight, &bytes(|[_, r, g, b]| vec![r, g, b, 9]));
    assert_eq!(whole(&load("a.png", &rgb, PackedOrder::RedFirst).unwrap()), ids);
    assert_eq!(whole(&load("a.png", &bgr, PackedOrder::BlueFirst).unwrap()), ids);
    assert_eq!(whole(&load("a.png", &rgba, PackedOrder::RedFirst).unwrap()), ids);
    let grey = png(ColorType::Grayscale, BitDepth::Eight, &[0, 1, 2, 3, 4, 255]);
    let read = whole(&load("a.png", &grey, PackedOrder::RedFirst).unwrap());
    assert_eq!(read, [0, 1, 2, 3, 4, 255]);
    let deep =
        png(ColorType::Grayscale, BitDepth::Sixteen, &[1, 2, 0, 1, 0, 2, 0, 3, 0, 4, 255, 255]);
    let read = whole(&load("a.png", &deep, PackedOrder::RedFirst).unwrap());
    assert_eq!(read, [258, 1, 2, 3, 4, 65_535]);
}

#[test]
fn exr_channels_are_read_as_they_are() {
    let resolution = Resolution::new(3, 2).unwrap();
    for samples in [Samples::Uint(IDS.to_vec()), Samples::Float(IDS.map(|v| v as f32).to_vec())] {
        let planes = vec![Plane { name: "ids".to_owned(), samples }];
        let window = resolution.window();
        let film = Film { resolution, window, planes, description: String::new() };
        let bytes = encode_exr(&film).unwrap();
        let plane = load("a.exr", &bytes, PackedOrder::RedFirst).unwrap();
        assert_eq!(whole(&plane), IDS.map(i64::from));
        assert_eq!(plane.name, "ids");
    }
}
