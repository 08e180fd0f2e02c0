//! Values of lookups: exact ones on small textures, and bounds on all of them.

use super::*;
use dashu_int::IBig;
use dashu_ratio::RBig;
use proptest::prelude::*;
use truecast::shade::footprint::Footprint;
use truecast::shade::texture::{level_of_detail, sample};

/// The grey value at a point of the uv plane.
fn at(texture: &Texture, filter: Filter, wrap: Wrap, u: f64, v: f64) -> f64 {
    let [r, g, b] = sample(texture, &reference(filter, wrap), [u, v], None);
    assert!(r == g && g == b);
    r
}

const BOTH: [Wrap; 2] = [Wrap::Repeat, Wrap::Clamp];

#[test]
fn nearest_is_the_texel_that_holds_the_point() {
    // 0.25 and 0.5 below, 0.75 and 1 above.
    let four = grey(2, &[0.25, 0.5, 0.75, 1.0]);
    for wrap in BOTH {
        let value = |u, v| at(&four, Filter::Nearest, wrap, u, v);
        assert_eq!(value(0.0, 0.0), 0.25);
        assert_eq!(value(0.5 - 1e-7, 0.5 - 1e-7), 0.25);
        // A point that rounding puts beside a texel's edge lies on it.
        assert_eq!(value(0.5_f64.next_down(), 0.0), 0.5);
        assert_eq!(value(0.5_f64.next_up(), 0.0), 0.5);
        assert_eq!(value(0.5, 0.0), 0.5);
        assert_eq!(value(0.0, 0.5), 0.75);
        assert_eq!(value(0.75, 1.0 - 1e-7), 1.0);
    }
    let row = grey(4, &[0.0, 0.25, 0.5, 1.0]);
    let value = |u| at(&row, Filter::Nearest, Wrap::Repeat, u, 17.3);
    assert_eq!([0.1, 0.25, 0.6, 0.9].map(value), [0.0, 0.25, 0.5, 1.0]);
}

#[test]
fn bilinear_weighs_the_middles() {
    let row = grey(4, &[0.0, 0.25, 0.5, 1.0]);
    for wrap in BOTH {
        let value = |u| at(&row, Filter::Bilinear, wrap, u, 0.5);
        assert_eq!([0.125, 0.375, 0.625, 0.875].map(value), [0.0, 0.25, 0.5, 1.0]);
        assert_eq!([0.25, 0.5, 0.75].map(value), [0.125, 0.375, 0.75]);
        assert_eq!(value(0.6875), 0.625);
    }
    let four = grey(2, &[0.0, 1.0, 0.5, 0.25]);
    let value = |u, v| at(&four, Filter::Bilinear, Wrap::Repeat, u, v);
    assert_eq!(value(0.5, 0.5), 0.4375);
    assert_eq!(value(0.25, 0.5), 0.25);
    // A quarter of the way to the right, half of the way up: ¾·¼ + ¼·⅝.
    assert_eq!(value(0.375, 0.5), 0.34375);
}

#[test]
fn the_rim_repeats_or_stays() {
    let row = grey(4, &[0.0, 0.25, 0.5, 1.0]);
    let value = |filter, wrap, u| at(&row, filter, wrap, u, 0.5);
    // Exactly 1 is the first texel again, or still the last.
    assert_eq!(value(Filter::Nearest, Wrap::Repeat, 1.0), 0.0);
    assert_eq!(value(Filter::Nearest, Wrap::Clamp, 1.0), 1.0);
    assert_eq!(value(Filter::Bilinear, Wrap::Repeat, 1.0), 0.5);
    assert_eq!(value(Filter::Bilinear, Wrap::Repeat, 0.0), 0.5);
    assert_eq!(value(Filter::Bilinear, Wrap::Clamp, 1.0), 1.0);
    assert_eq!(value(Filter::Bilinear, Wrap::Clamp, 0.0), 0.0);
    for filter in [Filter::Nearest, Filter::Bilinear] {
        for u in [0.125, 0.3125, 0.75, 0.9375] {
            for whole in [-1024.0, -1.0, 1.0, 3.0, 1e9] {
                // These sums are exact.
                let there = value(filter, Wrap::Repeat, whole + u);
                assert_eq!(there, value(filter, Wrap::Repeat, u), "{whole} + {u}");
            }
        }
        assert_eq!(value(filter, Wrap::Clamp, -7.0), 0.0);
        assert_eq!(value(filter, Wrap::Clamp, 7.0), 1.0);
    }
    // Just below a whole number is the last texel; what only rounding keeps below is the first.
    assert_eq!(value(Filter::Nearest, Wrap::Repeat, -1e-7), 1.0);
    assert_eq!(value(Filter::Nearest, Wrap::Repeat, -1e-20), 0.0);
    assert_eq!(value(Filter::Nearest, Wrap::Repeat, -5e-324), 0.0);
    assert_eq!(value(Filter::Bilinear, Wrap::Repeat, -1e-20), 0.5);
}

#[test]
fn the_nearest_column_is_that_of_the_exact_product() {
    // Points within half a step of a texel's edge lie on the edge; all others in the texel of the
    // exact product.
    let half_step = 0.5 / f64::from(1 << 24);
    let mut moved = 0;
    for width in 1_u32..=130 {
        let column = |i: u32| i as f32 / 128.0;
        let texels: Vec<f32> = (0..width).map(column).collect();
        let row = grey(width, &texels);
        for boundary in 1..width {
            let u = f64::from(boundary) / f64::from(width);
            let beside = 1.01 * half_step / f64::from(width);
            for u in [u - beside, u.next_down(), u, u.next_up(), u + beside] {
                let exact = RBig::try_from(u).unwrap() * RBig::from(IBig::from(width));
                let exact_column = u32::try_from(exact.floor()).unwrap();
                let is_beside = (u * f64::from(width) - f64::from(boundary)).abs() > half_step;
                let expected = if is_beside { exact_column } else { boundary };
                let found = at(&row, Filter::Nearest, Wrap::Repeat, u, 0.5);
                assert_eq!(found, f64::from(column(expected)), "{u} × {width}");
                moved += u32::from(exact_column != expected);
            }
        }
    }
    assert!(moved > 0, "the exact product would do");
}

#[test]
fn one_texel_and_one_column() {
    for filter in [Filter::Nearest, Filter::Bilinear, Filter::Mip] {
        for wrap in BOTH {
            let single = grey(1, &[0.3]);
            let column = grey(1, &[0.25, 0.75]);
            for u in [-3.7, 0.0, 0.5, 1.0, 1e300] {
                assert_eq!(at(&single, filter, wrap, u, -u), f64::from(0.3_f32));
                assert_eq!(at(&column, filter, wrap, u, 0.25), 0.25);
                assert_eq!(at(&column, filter, wrap, u, 0.75), 0.75);
            }
        }
    }
}

#[test]
fn scale_comes_before_offset() {
    let row = grey(4, &[0.0, 0.25, 0.5, 1.0]);
    let stretched = TextureRef {
        scale: [2.0, 1.0],
        offset: [0.25, 0.0],
        ..reference(Filter::Nearest, Wrap::Repeat)
    };
    // 2·0.125 + 0.25 and 2·0.375 + 0.25.
    assert_eq!(sample(&row, &stretched, [0.125, 0.5], None), [0.5; 3]);
    assert_eq!(sample(&row, &stretched, [0.375, 0.5], None), [0.0; 3]);
}

/// A footprint of as many texels of a square texture.
fn footprint(texture: &Texture, texels: f64) -> Footprint {
    let step = texels / f64::from(texture.base().width());
    Footprint { per_column: [step, 0.0], per_row: [0.0, step / 2.0] }
}

#[test]
fn the_level_follows_the_footprint() {
    let texels: Vec<f32> = (0..16).map(|i| i as f32 / 16.0).collect();
    let texture = grey(4, &texels).with_levels();
    let mip = reference(Filter::Mip, Wrap::Clamp);
    for level in -3..6 {
        let footprint = footprint(&texture, 2.0_f64.powi(level));
        assert_eq!(level_of_detail(texture.base(), &mip, footprint), f64::from(level));
    }
    let value = |texels| sample(&texture, &mip, [0.0; 2], Some(footprint(&texture, texels)))[0];
    // The corner itself, its block of four, all sixteen.
    let corner = 0.0;
    let block = (0.0 + 1.0 + 4.0 + 5.0) / 64.0;
    let mean = 7.5 / 16.0;
    assert_eq!([0.0, 0.25, 1.0].map(value), [corner; 3]);
    assert_eq!(value(2.0), block);
    assert_eq!([4.0, 64.0, 1e300].map(value), [mean; 3]);
    // Half-way between two levels; 2^½ and its logarithm are within a few roundings.
    assert!((value(2.0_f64.sqrt()) - block / 2.0).abs() <= 1e-15);
    // The larger direction decides, with the factor of the reference.
    let scaled = TextureRef { scale: [1.0, 16.0], ..mip };
    let sideways = footprint(&texture, 1.0);
    assert_eq!(level_of_detail(texture.base(), &scaled, sideways), 3.0);
    // Without smaller levels there is the image itself.
    let bare = grey(4, &texels);
    assert_eq!(sample(&bare, &mip, [0.0; 2], Some(footprint(&bare, 64.0))), [corner; 3]);
}

/// Any f64 that a scene can hold as a coordinate, the hard ones often.
fn coordinate() -> impl Strategy<Value = f64> {
    let hard = prop_oneof![
        Just(0.0),
        Just(-0.0),
        Just(1.0),
        Just(-1.0),
        Just(1.0_f64.next_down()),
        Just(-5e-324),
        Just(-1e-17),
        Just(1e300),
        Just(-1e300),
        Just(f64::MAX),
        Just(f64::MIN),
        Just(9_007_199_254_740_993.0),
    ];
    prop_oneof![hard, -3.0..3.0, any::<f64>().prop_filter("finite", |c| c.is_finite())]
}

proptest! {
    #[test]
    fn every_value_lies_between_the_texels(
        width in 1_u32..9,
        texels in prop::collection::vec(0.0_f32..=1.0, 64),
        uv in [coordinate(), coordinate()],
        scale in [coordinate(), coordinate()],
        offset in [coordinate(), coordinate()],
        change in prop::array::uniform4(coordinate()),
        filter in 0_usize..3,
        wrap in 0_usize..2,
    ) {
        let count = texels.len() as u32 / width * width;
        let texture = grey(width, &texels[..count as usize]).with_levels();
        let texels = &texels[..count as usize];
        let [low, high] = [f32::min, f32::max].map(|fold| texels.iter().copied().reduce(fold));
        let (low, high) = (f64::from(low.unwrap()), f64::from(high.unwrap()));
        let plain = reference(Filter::NAMED[filter].1, BOTH[wrap]);
        let moved = TextureRef { scale, offset, ..plain };
        let [a, b, c, d] = change;
        let footprint = Footprint { per_column: [a, b], per_row: [c, d] };
        for reference in [plain, moved] {
            for footprint in [None, Some(footprint)] {
                for value in sample(&texture, &reference, uv, footprint) {
                    // NaN fails too.
                    prop_assert!((low..=high).contains(&value), "{value} {low} {high}");
                }
            }
        }
    }

    #[test]
    fn one_colour_is_that_colour_at_every_level(
        width in 1_u32..20,
        height in 1_u32..20,
        value in 0.0_f32..=1.0,
        uv in [coordinate(), coordinate()],
        texels in 0.0_f64..100.0,
    ) {
        let texture = grey(width, &vec![value; (width * height) as usize]).with_levels();
        let mip = reference(Filter::Mip, Wrap::Repeat);
        let found = sample(&texture, &mip, uv, Some(footprint(&texture, texels)));
        prop_assert_eq!(found, [f64::from(value); 3]);
    }
}
