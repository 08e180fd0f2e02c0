//! The integration tests, one binary. Each module says what belongs in it.

// The arbiter against golden images, hand values and its own undiscarded self.
mod arbiter;
// Frames in bands, and the way that a frame takes.
mod bands;
// The benchmark: report, baselines, no time for a wrong kernel.
mod bench;
// Only the effects that a scene calls for: neutral, uncounted, measured.
mod called_for;
// The ray caster on golden and hard scenes: all build presets, tile sizes, threads.
mod cast;
// The hard cases by their names, through every configuration and before the arbiter.
mod catalogue;
// The check finds damaged answers and blames the right path.
mod check_can_fail;
// Colours that hang on a rounding, before the check.
mod check_rims;
// The program as a user meets it.
mod cli;
// The oracle bundle: what it holds, and what it may replace.
mod export;
// The figures of the course texts: sheets, scenes, and what the texts say about them.
mod figures;
// Files written and read back: EXR, PNG, NPY, atomic writes.
mod film;
// Another program's ids and depths, held against the exact answer.
mod foreign;
// OpenCV and OpenGL cameras against pixel positions by textbook matrices.
mod foreign_cameras;
// Who may import whom: the house's floors as a table.
mod layers;
// One light at a time, or only the ambient parts.
mod light_choice;
// Lights written in the frame of the camera or of a mesh.
mod light_frames;
// Every row of the lighting systems by its name.
mod lighting;
// Presets of materials, and surfaces that no light touches.
mod material_presets;
// What accuracy costs: prices, their report, what has none.
mod cost;
// Goniometric diagrams: curves by an independent formula, SVG and PNG of the same marks.
mod lobe;
// OBJ and MTL, one test per misreading.
mod obj;
// What is seen through surfaces: exact order by both paths, and what comes of it in colour.
mod opacity;
// The rasterizer on golden and hard scenes: tile sizes, windows, threads.
mod raster;
// What the README shows is what the program does.
mod readme;
// Hard cases of traversal, scale and transformation: H50 to H89, both paths and the arbiter.
mod scale;
// Bad scene files: every error with its line and column.
mod scene_errors;
// The documented keys are the parser's keys.
mod scene_keys;
// Good scene files: defaults, camera forms, transforms, materials.
mod scene_load;
// The scenes that come with the project.
mod scenes;
// Hard shadows: the caster before the arbiter, at every pixel, with lights where it is hard.
mod shadow;
// Sheets: layout, cells that are plain renders, overrides, errors that name the cell.
mod sheet;
// Every special float in every number of a scene: a finite picture or an error with a place.
mod specials;
// Stable shading by its names, S01 to S35; the plane of doubtful cases.
mod stable;
// The stability mask against moved samples and moved vertices.
mod stability;
// 200 generated scenes made of structure: both paths agree at every pixel.
mod structured;
// Golden scenes and builders that several modules use.
mod support;
// Textures: lookups, footprints, files of scenes and of material libraries.
mod textures;
// Colours of vertices, from the OBJ text to the mesh.
mod vertex_colors;
// Vertex normals by weight and crease, from a scene file.
mod vertex_normals;
// Several samples per pixel, as the program gives them.
mod supersampling;
// The levels without proof, on both paths: right, wrong and refused where they must be.
mod unproven;
// The list of visible triangles, and what lies between pixel centres.
mod visible;
// The rasterizer as graphics processors have it: exactly once, and where it may differ.
mod watertight;
