//! The integration tests, one binary. Each module says what belongs in it.

// Files written and read back: EXR, PNG, NPY, atomic writes.
mod film;
// Bad scene files: every error with its line and column.
mod scene_errors;
//! tests

mod obj;
//! Everything that needs the library as a whole, in one binary.

mod lighting;
mod cast;
