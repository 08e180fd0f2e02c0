//! tests

mod raster;
