//! Embree's C interface, as much of it as casting rays at triangles takes, behind safe functions.
//!
//! The library is loaded when it is asked for, never linked. Layouts and signatures are those of the
//! public headers `embree3/rtcore*.h` and `embree4/rtcore*.h`; the two versions differ only in the
//! calls that cast ([`Cast`]). The only file of the crate with `unsafe`. What it relies on:
//!
//! * Functions are taken by names whose signatures are fixed within a major version, and the major
//!   version is asked for before any of those that differ is called.
//! * The library is never unloaded, so the functions outlive everything.
//! * A [`Tree`] owns the buffers that Embree reads while it builds, does not change them, and has
//!   checked that every corner names a vertex. It releases scene and device once, when dropped.
//! * Casting at a committed scene is thread-safe by Embree's contract; nothing else is called then.
//! * [`Packet`] is at least as large and as strictly aligned as Embree's ray-hit structures.
#![allow(unsafe_code, reason = "a C library is called; see the invariants above")]

use libloading::Library;
use std::ffi::{CString, c_char, c_int, c_uint, c_void};
use std::mem::ManuallyDrop;
use std::ptr;

/// Anything that Embree hands out.
type Handle = *mut c_void;

/// `RTC_DEVICE_PROPERTY_VERSION`: 10000 · major + 100 · minor + patch.
const VERSION: c_int = 0;
/// `RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED`.
const NATIVE_16: c_int = 34;
/// `RTC_BUILD_QUALITY_MEDIUM`.
const MEDIUM: c_int = 1;
/// `RTC_SCENE_FLAG_ROBUST`.
const ROBUST: c_int = 1 << 2;
/// `RTC_GEOMETRY_TYPE_TRIANGLE`.
const TRIANGLES: c_int = 0;
/// `RTC_BUFFER_TYPE_INDEX` with `RTC_FORMAT_UINT3`.
const INDICES: (c_int, c_int) = (0, 0x5003);
/// `RTC_BUFFER_TYPE_VERTEX` with `RTC_FORMAT_FLOAT3`.
const VERTICES: (c_int, c_int) = (1, 0x9003);
/// Bytes of three f32 or u32.
const STRIDE: usize = 12;
/// Embree reads vertices and indices 16 bytes at a time: one more number than the last has.
const PADDING: usize = 1;

/// No geometry, no triangle: `RTC_INVALID_GEOMETRY_ID`.
pub(super) const NOTHING: u32 = u32::MAX;

/// A symbol of the library as a plain function.
macro_rules! symbol {
    ($library:expr, $name:literal) => {
        // Sound by the first two invariants above: the field's type is the header's signature.
        unsafe { $library.get(concat!($name, "\0").as_bytes()) }
            .map(|symbol| *symbol)
            .map_err(|error| error.to_string())?
    };
}

/// The functions that both versions have alike.
#[derive(Clone, Copy)]
struct Functions {
    new_device: unsafe extern "C" fn(*const c_char) -> Handle,
    release_device: unsafe extern "C" fn(Handle),
    device_property: unsafe extern "C" fn(Handle, c_int) -> isize,
    device_error: unsafe extern "C" fn(Handle) -> c_int,
    new_scene: unsafe extern "C" fn(Handle) -> Handle,
    release_scene: unsafe extern "C" fn(Handle),
    set_flags: unsafe extern "C" fn(Handle, c_int),
    set_quality: unsafe extern "C" fn(Handle, c_int),
    commit_scene: unsafe extern "C" fn(Handle),
    new_geometry: unsafe extern "C" fn(Handle, c_int) -> Handle,
    release_geometry: unsafe extern "C" fn(Handle),
    set_buffer:
        unsafe extern "C" fn(Handle, c_int, c_uint, c_int, *const c_void, usize, usize, usize),
    set_geometry_quality: unsafe extern "C" fn(Handle, c_int),
    commit_geometry: unsafe extern "C" fn(Handle),
    attach_geometry: unsafe extern "C" fn(Handle, Handle) -> c_uint,
    cast: Cast,
}

/// Scene, context or arguments and rays, in the version's order; a packet has its mask first.
type One = unsafe extern "C" fn(Handle, *mut c_void, *mut c_void);
type Many = unsafe extern "C" fn(*const i32, Handle, *mut c_void, *mut c_void);

/// The calls that cast 1, 8 and 16 rays, and that ask of 1 whether it meets anything. Version 3 takes the context before the rays, version 4
/// arguments after them.
#[derive(Clone, Copy)]
struct Cast {
    one: One,
    occluded: One,
    eight: Many,
    sixteen: Many,
    is_version_3: bool,
}

/// `RTCIntersectContext` of version 3.
#[repr(C)]
struct Context {
    flags: c_int,
    filter: *const c_void,
    instance: u32,
    width_factor: f32,
}

/// `RTCIntersectArguments` of version 4.
#[repr(C)]
struct Arguments {
    flags: c_int,
    features: c_uint,
    context: *const c_void,
    filter: *const c_void,
    intersect: *const c_void,
    width_factor: f32,
}

/// `RTCRayHit`, `RTCRayHit8` or `RTCRayHit16`: every field once per lane. `instance` is two fields in
/// newer versions; the spare one is harmless in older ones.
#[repr(C, align(64))]
pub(super) struct Packet<const N: usize> {
    pub(super) origin: [[f32; N]; 3],
    near: [f32; N],
    pub(super) direction: [[f32; N]; 3],
    time: [f32; N],
    /// The ray's end; after a hit its t.
    pub(super) far: [f32; N],
    mask: [u32; N],
    ray: [u32; N],
    flags: [u32; N],
    normal: [[f32; N]; 3],
    barycentric: [[f32; N]; 2],
    /// The triangle, or [`NOTHING`].
    pub(super) triangle: [u32; N],
    geometry: [u32; N],
    instance: [[u32; N]; 2],
}

impl<const N: usize> Packet<N> {
    /// Rays from one origin, without directions yet.
    pub(super) fn from(origin: [f32; 3]) -> Self {
        Self {
            origin: origin.map(|c| [c; N]),
            near: [0.0; N],
            direction: [[0.0; N]; 3],
            time: [0.0; N],
            far: [f32::INFINITY; N],
            mask: [u32::MAX; N],
            ray: [0; N],
            flags: [0; N],
            normal: [[0.0; N]; 3],
            barycentric: [[0.0; N]; 2],
            triangle: [NOTHING; N],
            geometry: [NOTHING; N],
            instance: [[NOTHING; N]; 2],
        }
    }

    /// Makes a lane a ray that has hit nothing.
    #[inline(always)]
    pub(super) fn aim(&mut self, lane: usize, direction: [f32; 3]) {
        for (axis, component) in self.direction.iter_mut().zip(direction) {
            axis[lane] = component;
        }
        self.far[lane] = f32::INFINITY;
        self.triangle[lane] = NOTHING;
        self.geometry[lane] = NOTHING;
    }
}

impl Packet<1> {
    /// Makes it a ray between two ends that has hit nothing.
    #[inline(always)]
    pub(super) fn reach(&mut self, origin: [f32; 3], direction: [f32; 3], [near, far]: [f32; 2]) {
        self.origin = origin.map(|c| [c]);
        self.aim(0, direction);
        (self.near, self.far) = ([near], [far]);
    }
}

/// Which lanes of a packet are rays: −1, else 0.
#[repr(C, align(64))]
pub(super) struct Lanes<const N: usize>(pub(super) [i32; N]);

/// What a call takes besides scene and rays. One per thread.
pub(super) struct Call {
    context: Context,
    arguments: Arguments,
}

impl Call {
    /// For rays that run together, from one eye through neighbouring pixels.
    pub(super) fn coherent() -> Self {
        Self {
            // `RTC_INTERSECT_CONTEXT_FLAG_COHERENT`.
            context: Context {
                flags: 1,
                filter: ptr::null(),
                instance: NOTHING,
                width_factor: 0.0,
            },
            arguments: Arguments {
                // `RTC_RAY_QUERY_FLAG_COHERENT`, all features.
                flags: 1 << 16,
                features: c_uint::MAX,
                context: ptr::null(),
                filter: ptr::null(),
                intersect: ptr::null(),
                width_factor: 0.0,
            },
        }
    }
}

/// A loaded library.
#[derive(Clone, Copy)]
pub(super) struct Embree {
    functions: Functions,
    /// `[major, minor, patch]`.
    pub(super) version: [isize; 3],
}

impl Embree {
    /// Loads a shared library by path or by the name under which the system finds it.
    pub(super) fn load(name: &std::ffi::OsStr) -> Result<Self, String> {
        // Loading runs the library's initializers: whoever names a library trusts it.
        let library = unsafe { Library::new(name) }.map_err(|error| error.to_string())?;
        let library = ManuallyDrop::new(library);
        let functions = Functions {
            new_device: symbol!(library, "rtcNewDevice"),
            release_device: symbol!(library, "rtcReleaseDevice"),
            device_property: symbol!(library, "rtcGetDeviceProperty"),
            device_error: symbol!(library, "rtcGetDeviceError"),
            new_scene: symbol!(library, "rtcNewScene"),
            release_scene: symbol!(library, "rtcReleaseScene"),
            set_flags: symbol!(library, "rtcSetSceneFlags"),
            set_quality: symbol!(library, "rtcSetSceneBuildQuality"),
            commit_scene: symbol!(library, "rtcCommitScene"),
            new_geometry: symbol!(library, "rtcNewGeometry"),
            release_geometry: symbol!(library, "rtcReleaseGeometry"),
            set_buffer: symbol!(library, "rtcSetSharedGeometryBuffer"),
            set_geometry_quality: symbol!(library, "rtcSetGeometryBuildQuality"),
            commit_geometry: symbol!(library, "rtcCommitGeometry"),
            attach_geometry: symbol!(library, "rtcAttachGeometry"),
            cast: Cast {
                one: symbol!(library, "rtcIntersect1"),
                occluded: symbol!(library, "rtcOccluded1"),
                eight: symbol!(library, "rtcIntersect8"),
                sixteen: symbol!(library, "rtcIntersect16"),
                is_version_3: false,
            },
        };
        let mut embree = Self { functions, version: [0; 3] };
        let device = embree.device(c"threads=1")?;
        let version = unsafe { (functions.device_property)(device, VERSION) };
        unsafe { (functions.release_device)(device) };
        embree.version = [version / 10_000, version / 100 % 100, version % 100];
        embree.functions.cast.is_version_3 = match embree.version[0] {
            3 => true,
            4 => false,
            major => return Err(format!("version {major} is neither 3 nor 4")),
        };
        Ok(embree)
    }

    fn device(&self, configuration: &std::ffi::CStr) -> Result<Handle, String> {
        let device = unsafe { (self.functions.new_device)(configuration.as_ptr()) };
        if device.is_null() {
            return Err(format!("no device for \"{}\"", configuration.to_string_lossy()));
        }
        Ok(device)
    }

    /// Builds a tree of medium quality, on as many threads as the configuration says.
    pub(super) fn build(
        &self,
        configuration: &str,
        (positions, corners): (&[[f32; 3]], &[[u32; 3]]),
        is_robust: bool,
    ) -> Result<Tree, String> {
        assert!(
            corners.as_flattened().iter().all(|&corner| (corner as usize) < positions.len()),
            "every corner names a vertex"
        );
        let padded = |count: usize| 3 * count + PADDING;
        let mut vertices = Vec::with_capacity(padded(positions.len()));
        vertices.extend_from_slice(positions.as_flattened());
        vertices.resize(padded(positions.len()), 0.0);
        let mut indices = Vec::with_capacity(padded(corners.len()));
        indices.extend_from_slice(corners.as_flattened());
        indices.resize(padded(corners.len()), 0);
        let configuration = CString::new(configuration).map_err(|error| error.to_string())?;
        let device = self.device(&configuration)?;
        let functions = self.functions;
        let scene = unsafe { (functions.new_scene)(device) };
        // From here on dropping releases both, whatever fails.
        let tree = Tree { functions, device, scene, _vertices: vertices, _indices: indices };
        unsafe {
            (functions.set_flags)(scene, if is_robust { ROBUST } else { 0 });
            (functions.set_quality)(scene, MEDIUM);
            let geometry = (functions.new_geometry)(device, TRIANGLES);
            let share = |(kind, format), start: *const c_void, count| {
                (functions.set_buffer)(geometry, kind, 0, format, start, 0, STRIDE, count);
            };
            share(INDICES, tree._indices.as_ptr().cast(), corners.len());
            share(VERTICES, tree._vertices.as_ptr().cast(), positions.len());
            (functions.set_geometry_quality)(geometry, MEDIUM);
            (functions.commit_geometry)(geometry);
            (functions.attach_geometry)(scene, geometry);
            (functions.release_geometry)(geometry);
            (functions.commit_scene)(scene);
        }
        match unsafe { (functions.device_error)(device) } {
            0 => Ok(tree),
            code => Err(format!("building failed with error {code}")),
        }
    }
}

/// A built scene with its device and the buffers it was built from.
pub(super) struct Tree {
    functions: Functions,
    device: Handle,
    scene: Handle,
    _vertices: Vec<f32>,
    _indices: Vec<u32>,
}

// Only `closest`, `is_occluded` and `has_16_lanes` use a shared tree, and Embree allows both from any thread.
unsafe impl Send for Tree {}
unsafe impl Sync for Tree {}

impl Tree {
    /// Whether packets of 16 rays are traced as such on this machine and instruction set.
    pub(super) fn has_16_lanes(&self) -> bool {
        unsafe { (self.functions.device_property)(self.device, NATIVE_16) != 0 }
    }

    /// Finds the closest hit of every lane that is a ray. N is 1, 8 or 16; one lane is always a ray.
    #[inline(always)]
    pub(super) fn closest<const N: usize>(
        &self,
        call: &mut Call,
        lanes: &Lanes<N>,
        packet: &mut Packet<N>,
    ) {
        const { assert!(N == 1 || N == 8 || N == 16) };
        let Cast { one, eight, sixteen, is_version_3, .. } = self.functions.cast;
        let rays = ptr::from_mut(packet).cast();
        let (second, third) = match is_version_3 {
            true => (ptr::from_mut(&mut call.context).cast(), rays),
            false => (rays, ptr::from_mut(&mut call.arguments).cast()),
        };
        let valid = lanes.0.as_ptr();
        unsafe {
            match N {
                1 => one(self.scene, second, third),
                8 => eight(valid, self.scene, second, third),
                _ => sixteen(valid, self.scene, second, third),
            }
        }
    }
}

impl Tree {
    /// Whether a ray meets anything between its ends. `RTCRay` is how `RTCRayHit` begins, and the
    /// arguments of both calls have one layout.
    #[inline(always)]
    pub(super) fn is_occluded(&self, call: &mut Call, ray: &mut Packet<1>) -> bool {
        let Cast { occluded, is_version_3, .. } = self.functions.cast;
        let rays = ptr::from_mut(ray).cast();
        let (second, third) = match is_version_3 {
            true => (ptr::from_mut(&mut call.context).cast(), rays),
            false => (rays, ptr::from_mut(&mut call.arguments).cast()),
        };
        unsafe { occluded(self.scene, second, third) };
        // The end of a ray that is occluded becomes −∞.
        ray.far[0] < 0.0
    }
}

impl Drop for Tree {
    fn drop(&mut self) {
        unsafe {
            (self.functions.release_scene)(self.scene);
            (self.functions.release_device)(self.device);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn structures_have_the_layouts_of_the_headers() {
        // RTCRay is 48 bytes, RTCHit 32 or 36, both aligned to 16; a packet has N of each field.
        assert_eq!(std::mem::offset_of!(Packet<1>, normal), 48);
        assert_eq!(std::mem::offset_of!(Packet<8>, normal), 8 * 48);
        assert_eq!(std::mem::offset_of!(Packet<16>, normal), 16 * 48);
        assert_eq!(std::mem::offset_of!(Packet<16>, triangle), 16 * (48 + 20));
        assert_eq!(std::mem::offset_of!(Packet<16>, far), 16 * 32);
        assert!(size_of::<Packet<1>>() >= 96 && size_of::<Packet<16>>() >= 16 * 84);
        assert_eq!(std::mem::offset_of!(Context, filter), 8);
        assert_eq!(std::mem::offset_of!(Arguments, context), 8);
    }
}
