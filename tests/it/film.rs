//! What the picture files hold, read back by code that shares nothing with the writers.

mod exr;
mod png_npy;
mod write;

use truecast::film::{Film, Plane, Samples};
use truecast::pixel::{Resolution, Window};

/// Bit patterns that a careless copy changes: signed zeros, subnormals, infinities, quiet and
/// signalling NaNs with payloads, the least and the greatest.
const SPECIAL_BITS: [u32; 14] = [
    0x0000_0000,
    0x8000_0000,
    0x0000_0001,
    0x807f_ffff,
    0x0080_0000,
    0x3f80_0000,
    0x3f80_0001,
    0x7f7f_ffff,
    0x7f80_0000,
    0xff80_0000,
    0x7fc0_0000,
    0xffc1_2345,
    0x7f80_0001,
    0xffff_ffff,
];

/// A film of 40 × 37 pixels (rows no multiple of a block's 16) or a window of it, whose planes are
/// in no order, hold [`SPECIAL_BITS`] in turn among smooth values, and differ from one another.
fn specimen(window: [u32; 4]) -> Film {
    let resolution = Resolution::new(40, 37).unwrap();
    let [x0, y0, x1, y1] = window;
    let window = Window::new(resolution, x0, y0, x1, y1).unwrap();
    let planes = ["R", "id.prim", "Z", "N.X", "A", "G", "bary.u", "B", "cover", "u"]
        .iter()
        .enumerate()
        .map(|(plane, &name)| {
            let bits = window.pixels().map(|pixel| {
                let place = pixel.x as usize + 3 * pixel.y as usize + plane;
                match place % 5 {
                    0 => SPECIAL_BITS[place / 5 % SPECIAL_BITS.len()],
                    _ => (0.01 * place as f32).to_bits(),
                }
            });
            let samples = match name {
                "id.prim" | "cover" => Samples::Uint(bits.collect()),
                _ => Samples::Float(bits.map(f32::from_bits).collect()),
            };
            Plane { name: name.to_owned(), samples }
        })
        .collect();
    Film { resolution, window, planes, description: "{\"material\":\"Grünspan ✓\"}".to_owned() }
}

/// A film of finite colours only: `colour(x, y)` at each pixel of the window.
fn colours(resolution: Resolution, window: Window, colour: impl Fn(u32, u32) -> [f32; 3]) -> Film {
    let planes = ["R", "G", "B"]
        .iter()
        .enumerate()
        .map(|(channel, &name)| {
            let values = window.pixels().map(|pixel| colour(pixel.x, pixel.y)[channel]).collect();
            Plane { name: name.to_owned(), samples: Samples::Float(values) }
        })
        .collect();
    Film { resolution, window, planes, description: String::new() }
}

fn bits(samples: &Samples) -> Vec<u32> {
    match samples {
        Samples::Float(values) => values.iter().map(|value| value.to_bits()).collect(),
        Samples::Uint(values) => values.clone(),
    }
}
