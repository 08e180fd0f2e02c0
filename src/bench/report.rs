//! A report as a table for people, as JSON for programs and baselines, as CSV for spreadsheets, and
//! as bars.
//!
//! Only layout: every number was found before. Each column or cell names its unit.

mod csv;
mod growth;
mod json;
mod svg;
mod table;

pub use csv::to_csv;
pub use growth::{Growth, GrowthPoint, growth_drawing, growths, reading};
pub use json::{SCHEMA, to_json};
pub use svg::to_drawing;
pub use table::to_table;
