//! Prices as tables for people, as JSON for programs, as CSV for spreadsheets, and as points of error
//! against time.
//!
//! Only layout: every number was found before. Each column or key names its unit.

mod csv;
mod json;
mod svg;
mod table;

pub use csv::to_csv;
pub use json::{SCHEMA, to_json};
pub use svg::to_drawing;
pub use table::to_table;
