//! PNG and NPY: codes, chunks, clip counts, array header.

use truecast::color::srgb_code;
use truecast::film::{
    ClipCount, Film, FilmError, Plane, Samples, encode_npy_ids, encode_picture, encode_png,
};
use truecast::pixel::{Resolution, Window};

use super::{colours, specimen};

/// Width, height and RGB bytes, by the reference reader of the PNG crate.
fn read_png(bytes: &[u8]) -> (u32, u32, Vec<u8>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    assert_eq!(reader.output_color_type(), (png::ColorType::Rgb, png::BitDepth::Eight));
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut pixels).unwrap();
    (frame.width, frame.height, pixels)
}

/// Names of the chunks, in the file's order.
fn chunk_names(bytes: &[u8]) -> Vec<String> {
    let mut names = Vec::new();
    let mut rest = &bytes[8..];
    while !rest.is_empty() {
        let length = u32::from_be_bytes(rest[..4].try_into().unwrap()) as usize;
        names.push(String::from_utf8(rest[4..8].to_vec()).unwrap());
        rest = &rest[12 + length..];
    }
    names
}

fn ramp(x: u32, y: u32) -> [f32; 3] {
    [x as f32 / 63.0, y as f32 / 47.0, (x * y) as f32 / 2961.0]
}

#[test]
fn a_png_holds_the_codes_of_the_window() {
    let frame = Resolution::new(64, 48).unwrap();
    for window in [frame.window(), Window::new(frame, 3, 5, 61, 44).unwrap()] {
        let (bytes, clipped) = encode_png(&colours(frame, window, ramp)).unwrap();
        let (width, height, pixels) = read_png(&bytes);
        assert_eq!([width, height], [window.width(), window.height()]);
        let expected: Vec<u8> = window
            .pixels()
            .flat_map(|pixel| ramp(pixel.x, pixel.y).map(|value| srgb_code(f64::from(value))))
            .collect();
        assert_eq!(pixels, expected);
        assert_eq!(clipped, ClipCount::default());
    }
}

#[test]
fn a_png_says_it_is_srgb_before_its_pixels() {
    let frame = Resolution::new(64, 48).unwrap();
    let (bytes, _) = encode_png(&colours(frame, frame.window(), ramp)).unwrap();
    let names = chunk_names(&bytes);
    assert_eq!(names[..2], ["IHDR", "sRGB"]);
    assert!(names[2..names.len() - 1].iter().all(|name| name == "IDAT"), "{names:?}");
    assert_eq!(names[names.len() - 1], "IEND");
    let picture = image::RgbImage::from_fn(5, 4, |x, y| image::Rgb([x as u8, y as u8, 255]));
    let bytes = encode_picture(&picture).unwrap();
    assert_eq!(chunk_names(&bytes)[..2], ["IHDR", "sRGB"]);
    assert_eq!(read_png(&bytes), (5, 4, picture.into_raw()));
}

#[test]
fn clipped_pixels_are_counted_once_each_way() {
    let frame = Resolution::new(6, 1).unwrap();
    let above = 1.0_f32.next_up();
    let row = [
        [0.0, -0.0, 1.0],      // in range
        [above, 2.0, 0.5],     // above, twice in one pixel
        [0.5, -1e-30, 0.5],    // below
        [-1.0, 0.5, 9.0],      // both
        [0.25, 0.5, f32::MAX], // above
        [1.0, 1.0, 1.0],       // in range
    ];
    let film = colours(frame, frame.window(), |x, _| row[x as usize]);
    let (bytes, clipped) = encode_png(&film).unwrap();
    assert_eq!(clipped, ClipCount { above: 3, below: 2 });
    let (_, _, pixels) = read_png(&bytes);
    assert_eq!(pixels[..6], [0, 0, 255, 255, 255, 188]);
    assert_eq!(pixels[9..12], [0, 188, 255]);
}

#[test]
fn an_infinite_or_undefined_colour_is_an_error_at_its_pixel() {
    let frame = Resolution::new(64, 48).unwrap();
    let window = Window::new(frame, 10, 20, 60, 48).unwrap();
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let film = colours(frame, window, |x, y| match (x, y) {
            (30, 41) | (12, 47) => [0.0, bad, 0.0],
            _ => [0.5; 3],
        });
        match encode_png(&film).unwrap_err() {
            FilmError::NotFinite { plane, x, y, value } => {
                assert_eq!((plane, x, y, value.to_bits()), ("G", 30, 41, bad.to_bits()));
            }
            other => panic!("{other}"),
        }
    }
}

#[test]
fn a_format_names_the_plane_it_lacks() {
    let frame = Resolution::new(2, 2).unwrap();
    let mut film = colours(frame, frame.window(), |_, _| [0.5; 3]);
    let error = encode_npy_ids(&film).unwrap_err().to_string();
    assert!(error.contains("`id.prim` of unsigned integers"), "{error}");
    film.planes[1].samples = Samples::Uint(vec![0; 4]);
    let error = encode_png(&film).unwrap_err().to_string();
    assert!(error.contains("`G` of floats"), "{error}");
    let empty = image::RgbImage::new(0, 3);
    assert!(matches!(encode_picture(&empty), Err(FilmError::Encode { .. })));
}

#[test]
fn ids_are_a_little_endian_array_of_rows() {
    let frame = Resolution::new(9, 7).unwrap();
    let window = Window::new(frame, 1, 2, 4, 7).unwrap();
    let ids: Vec<u32> = window
        .pixels()
        .map(|pixel| if pixel.x == 2 { u32::MAX } else { 1000 * pixel.y + pixel.x })
        .collect();
    let plane = Plane { name: "id.prim".to_owned(), samples: Samples::Uint(ids.clone()) };
    let film = Film { resolution: frame, window, planes: vec![plane], description: String::new() };
    let bytes = encode_npy_ids(&film).unwrap();

    assert_eq!(bytes[..8], *b"\x93NUMPY\x01\x00");
    let header_size = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    assert_eq!((10 + header_size) % 16, 0, "the array is aligned");
    let header: String =
        str::from_utf8(&bytes[10..10 + header_size]).unwrap().split_whitespace().collect();
    for entry in ["'descr':'<u4'", "'fortran_order':False", "'shape':(5,3"] {
        assert!(header.contains(entry), "{header}");
    }
    let values: Vec<u32> = bytes[10 + header_size..]
        .chunks_exact(4)
        .map(|four| u32::from_le_bytes(four.try_into().unwrap()))
        .collect();
    assert_eq!(values, ids);
}

#[test]
fn png_bytes_do_not_depend_on_threads() {
    let frame = Resolution::new(64, 48).unwrap();
    let film = colours(frame, frame.window(), ramp);
    let reference = encode_png(&film).unwrap();
    for threads in [1, 2, 5] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert!(pool.install(|| encode_png(&film).unwrap()) == reference, "{threads} threads");
    }
    assert!(encode_png(&specimen([0, 0, 40, 37])).is_err(), "its colours are not all finite");
}
