//! Everything that needs the library as a whole, in one binary.

mod lighting;
