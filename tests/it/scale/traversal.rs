//! H50–H65: rays and scenes that a traversal loses, and that a build does not survive.

mod rays;
mod trees;
mod vertices;
