//! Scenes in which every number that a special float may replace stands in ‹›.

/// A scene text and the mesh files beside it; no mesh file where the text is empty.
pub(super) struct Form<'a> {
    pub(super) name: &'a str,
    pub(super) scene: &'a str,
    pub(super) obj: &'a str,
    pub(super) mtl: &'a str,
}

/// Look-at camera and a mesh file; exact camera, matrix and all lights; the other two cameras.
pub(super) const FORMS: [Form<'static>; 4] = [
    Form { name: "look-at", scene: LOOK_AT, obj: MESH, mtl: COLOURS },
    Form { name: "exact", scene: EXACT, obj: "", mtl: "" },
    Form { name: "opencv", scene: OPENCV, obj: "", mtl: "" },
    Form { name: "gl", scene: GL, obj: "", mtl: "" },
];

const LOOK_AT: &str = "version = 1
[image]
width = 7
height = 5
background = [‹0.1›, 0.2, ‹0.3›]
[camera]
eye = [‹0.5›, ‹1.0›, ‹6.0›]
target = [‹0.0›, ‹0.25›, ‹0.0›]
up = [‹0.0›, ‹1.0›, ‹0.0›]
fov_y_deg = ‹45.0›
[[mesh]]
file = \"mesh.obj\"
scale = [‹1.5›, ‹1.0›, ‹1.25›]
rotate_deg = [‹10.0›, ‹20.0›, ‹30.0›]
translate = [‹0.0›, ‹0.5›, ‹-0.5›]
[[light]]
type = \"spot\"
position = [‹2.0›, ‹3.0›, ‹4.0›]
target = [‹0.0›, ‹0.0›, ‹0.0›]
intensity = [‹1.0›, 0.9, 0.8]
attenuation = [‹1.0›, ‹0.5›, ‹0.25›]
cutoff_deg = ‹40.0›
exponent = ‹8.0›
";

const MESH: &str = "mtllib mesh.mtl
v ‹-2.0› ‹-2.0› ‹0.0›
v ‹2.0› ‹-2.0› ‹0.5›
v ‹0.0› ‹2.5› ‹-0.5›
v -3 -3 -2 ‹0.5› ‹0.25› 1
v 3 -3 -2
v 0 4 -2
vt ‹0.0› ‹0.25›
vt 1 0
vt 0 1
vn ‹0.0› ‹0.0› ‹1.0›
vn 0.5 0 1
vn 0 0.5 1
usemtl shiny
f 1/1/1 2/2/2 3/3/3
f 4 5 6
";

const COLOURS: &str = "newmtl shiny
Ka ‹0.1› 0.1 0.1
Kd ‹0.5› ‹0.6› 0.7
Ks ‹0.5› 0.5 0.5
Ke ‹0.0› 0 0
Ns ‹32.0›
";

const EXACT: &str = "version = 1
[image]
width = 7
height = 5
[camera.exact]
eye = [‹0.0›, ‹0.5›, ‹-8.0›]
d0 = [‹-3.5›, ‹-2.5›, ‹6.0›]
dx = [‹1.0›, ‹0.0›, ‹0.0›]
dy = [‹0.0›, ‹1.0›, ‹0.0›]
[[material]]
name = \"m\"
ka = [‹0.25›, 0.25, 0.25]
kd = [‹0.5›, 0.5, 0.5]
ks = [‹0.75›, 0.75, 0.75]
ke = [‹0.125›, 0.0, 0.0]
ns = ‹50.0›
opacity = ‹0.5›
[[mesh]]
shape = { box = { size = 4.0 } }
material = \"m\"
crease_deg = ‹60.0›
matrix = [
  [‹1.0›, ‹0.25›, ‹0.0›, ‹0.5›],
  [‹0.0›, ‹1.0›, ‹-0.25›, ‹0.0›],
  [‹0.5›, ‹0.0›, ‹1.0›, ‹1.0›],
  [0, 0, 0, 1],
]
[[light]]
type = \"ambient\"
ambient = [‹0.1›, 0.1, 0.1]
[[light]]
type = \"directional\"
aim = [‹0.5›, ‹-1.0›, ‹2.0›]
diffuse = [‹1.0›, 1.0, 1.0]
specular = [‹1.0›, 1.0, 1.0]
[[light]]
type = \"point\"
position = [‹2.0›, ‹3.0›, ‹-6.0›]
intensity = [‹1.0›, 1.0, 1.0]
attenuation = [‹1.0›, ‹0.0›, ‹0.5›]
ambient = [‹0.05›, 0.0, 0.0]
[[light]]
type = \"spot\"
position = [-2.0, 3.0, -6.0]
aim = [‹0.5›, ‹-0.75›, ‹1.5›]
intensity = [0.5, 0.5, 0.5]
cutoff_deg = ‹60.0›
exponent = ‹2.5›
";

const OPENCV: &str = "version = 1
[image]
width = 7
height = 5
[camera.opencv]
K = [[‹6.0›, ‹0.0›, ‹3.5›], [‹0.0›, ‹6.0›, ‹2.5›], [‹0.0›, ‹0.0›, ‹1.0›]]
R = [[‹1.0›, ‹0.0›, 0.0], [‹0.0›, 0.8, 0.6], [0.0, ‹-0.6›, ‹0.8›]]
t = [‹0.25›, ‹0.5›, ‹7.0›]
[[mesh]]
shape = { uv_sphere = { radius = ‹2.0›, around = 12, rings = 6 } }
vertex_normals = \"angle\"
scale = ‹1.0›
[[light]]
type = \"point\"
position = [1.0, 2.0, -9.0]
intensity = [1.0, 1.0, 1.0]
";

const GL: &str = "version = 1
[image]
width = 7
height = 5
[camera.gl]
view = [
  [‹1.0›, 0.0, ‹0.0›, ‹0.25›],
  [‹0.0›, ‹1.0›, 0.0, ‹-0.5›],
  [0.0, ‹0.0›, ‹1.0›, ‹-8.0›],
  [‹0.0›, 0.0, ‹0.0›, ‹1.0›],
]
projection = [
  [‹1.5›, ‹0.0›, ‹0.0›, 0.0],
  [0.0, ‹2.0›, ‹0.0›, ‹0.0›],
  [‹0.0›, 0.0, ‹-1.02›, ‹-0.2›],
  [‹0.0›, ‹0.0›, ‹-1.0›, ‹0.0›],
]
[[mesh]]
shape = { torus = { major = ‹2.0›, minor = ‹0.75›, around = 12, across = 6 } }
rotate_deg = [60.0, 0.0, 0.0]
[[mesh]]
shape = { cone = { radius = ‹1.0›, height = ‹1.5› } }
[[mesh]]
shape = { plane = { width = ‹6.0›, depth = ‹6.0› } }
translate = [0.0, -2.0, 0.0]
[[mesh]]
shape = { cylinder = { radius = ‹0.5›, height = ‹3.0› } }
[[light]]
type = \"directional\"
aim = [-1.0, -1.0, -1.0]
intensity = [1.0, 1.0, 1.0]
";
