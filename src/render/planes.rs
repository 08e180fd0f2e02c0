//! The planes a film can hold, by the names that users and EXR files give them.
//!
//! Only names and their grouping: `develop` fills them.

/// Planes that are asked for together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PlaneGroup {
    /// `R G B A`: linear radiance, and 1 on surfaces.
    Color,
    /// `Z`: depth along the view axis.
    Depth,
    /// `t`: ray parameter.
    RayParameter,
    /// `P.X P.Y P.Z`: the visible point.
    Position,
    /// `N.X N.Y N.Z`: unit face normal by winding.
    FaceNormal,
    /// `Ns.X Ns.Y Ns.Z`: the unit normal that shading used.
    ShadingNormal,
    /// `u v`: texture coordinates.
    TextureCoordinates,
    /// `bary.u bary.v`: weights of the second and third corner.
    Barycentric,
    /// `id.prim id.object id.material`.
    Identity,
    /// `facing`: +1, −1, or 0 where nothing is visible.
    Facing,
    /// `cover`: number of triangles that cross the ray.
    Cover,
    /// `verdict.level verdict.tie`. Without proof the level is that of the arithmetic that is
    /// believed, and only a depth buffer knows ties: its own.
    Verdict,
    /// `stable`: 1 where the answer is certainly the same within ±1/256 pixel.
    Stable,
    /// `invalid`: the doubtful cases that shading met at the pixel's centre, on the nearest surface,
    /// as the sum of
    ///
    /// | bit | case |
    /// |---|---|
    /// | 1 | a light lies at the surface point and gave its ambient part only |
    /// | 2 | \|N·L\| < 1e-13: rounding decides on which side of the terminator the point is |
    /// | 4 | L = −V: no halfway vector, no highlight |
    /// | 8 | the interpolated normal cancelled, and the face normal was used |
    /// | 16 | the face is too thin to have a normal |
    /// | 32 | directions interpolated from the corners cancelled, and the light gave its ambient part only |
    /// | 64 | a corner at or behind the eye plane: weights stayed perspective-correct |
    /// | 128 | the pixel's colour is beyond f32: infinite in the file |
    ///
    /// The bits are those of [`crate::shade::doubt`]; only 128 speaks of the whole pixel, with all
    /// its samples and surfaces.
    Invalid,
}

impl PlaneGroup {
    /// Every group, in the order of the file format's description.
    pub const ALL: [Self; 14] = [
        Self::Color,
        Self::Depth,
        Self::RayParameter,
        Self::Position,
        Self::FaceNormal,
        Self::ShadingNormal,
        Self::TextureCoordinates,
        Self::Barycentric,
        Self::Identity,
        Self::Facing,
        Self::Cover,
        Self::Verdict,
        Self::Stable,
        Self::Invalid,
    ];

    /// The name by which the group is asked for.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Color => "rgba",
            Self::Depth => "Z",
            Self::RayParameter => "t",
            Self::Position => "P",
            Self::FaceNormal => "N",
            Self::ShadingNormal => "Ns",
            Self::TextureCoordinates => "uv",
            Self::Barycentric => "bary",
            Self::Identity => "id",
            Self::Facing => "facing",
            Self::Cover => "cover",
            Self::Verdict => "verdict",
            Self::Stable => "stable",
            Self::Invalid => "invalid",
        }
    }

    /// Names of its planes.
    pub const fn planes(self) -> &'static [&'static str] {
        match self {
            Self::Color => &["R", "G", "B", "A"],
            Self::Depth => &["Z"],
            Self::RayParameter => &["t"],
            Self::Position => &["P.X", "P.Y", "P.Z"],
            Self::FaceNormal => &["N.X", "N.Y", "N.Z"],
            Self::ShadingNormal => &["Ns.X", "Ns.Y", "Ns.Z"],
            Self::TextureCoordinates => &["u", "v"],
            Self::Barycentric => &["bary.u", "bary.v"],
            Self::Identity => &["id.prim", "id.object", "id.material"],
            Self::Facing => &["facing"],
            Self::Cover => &["cover"],
            Self::Verdict => &["verdict.level", "verdict.tie"],
            Self::Stable => &["stable"],
            Self::Invalid => &["invalid"],
        }
    }
}

/// A list of planes named something that does not exist.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no plane `{name}`; planes are {}, and `all`", PlaneGroup::ALL.map(PlaneGroup::name).join(", "))]
pub struct UnknownPlane {
    /// The name.
    pub name: String,
}

/// A set of plane groups.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PlaneGroups(Vec<PlaneGroup>);

impl PlaneGroups {
    /// Every plane that comes with the visible triangle: all but `cover`, which must look past it,
    /// and `stable` and `invalid`, which take a pass of their own.
    pub fn standard() -> Self {
        let costs_more = [PlaneGroup::Cover, PlaneGroup::Stable, PlaneGroup::Invalid];
        Self(PlaneGroup::ALL.into_iter().filter(|group| !costs_more.contains(group)).collect())
    }

    /// Every plane.
    pub fn all() -> Self {
        Self(PlaneGroup::ALL.to_vec())
    }

    /// The groups of a comma-separated list: names of groups or of their planes, in any case of
    /// letters where that is not ambiguous, or `all`.
    ///
    /// # Errors
    /// [`UnknownPlane`] with the first name that is none.
    pub fn parse(list: &str) -> Result<Self, UnknownPlane> {
        let mut groups = Vec::new();
        for name in list.split(',').map(str::trim).filter(|name| !name.is_empty()) {
            if name.eq_ignore_ascii_case("all") {
                return Ok(Self::all());
            }
            let group = PlaneGroup::ALL
                .into_iter()
                .find(|group| group.name() == name || group.planes().contains(&name))
                .or_else(|| {
                    PlaneGroup::ALL
                        .into_iter()
                        .find(|group| group.name().eq_ignore_ascii_case(name))
                })
                .ok_or_else(|| UnknownPlane { name: name.to_owned() })?;
            groups.push(group);
        }
        groups.sort_unstable();
        groups.dedup();
        Ok(Self(groups))
    }

    /// Whether the group is in the set.
    pub fn has(&self, group: PlaneGroup) -> bool {
        self.0.contains(&group)
    }

    /// The set with one more group.
    #[must_use]
    pub fn with(mut self, group: PlaneGroup) -> Self {
        if !self.has(group) {
            self.0.push(group);
            self.0.sort_unstable();
        }
        self
    }

    /// The groups, in order.
    pub fn iter(&self) -> impl Iterator<Item = PlaneGroup> {
        self.0.iter().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_name_groups_or_planes() {
        let groups = PlaneGroups::parse("rgba, id.prim ,z").unwrap();
        let names: Vec<_> = groups.iter().map(PlaneGroup::name).collect();
        assert_eq!(names, ["rgba", "Z", "id"]);
        assert_eq!(PlaneGroups::parse("all").unwrap(), PlaneGroups::all());
        assert_eq!(PlaneGroups::parse("N").unwrap().iter().next(), Some(PlaneGroup::FaceNormal));
        assert!(PlaneGroups::parse("rgba,depht").unwrap_err().to_string().contains("depht"));
    }

    #[test]
    fn the_standard_set_never_looks_past_the_visible_triangle() {
        let standard = PlaneGroups::standard();
        let costly = [PlaneGroup::Invalid, PlaneGroup::Stable, PlaneGroup::Cover];
        assert!(costly.iter().all(|group| !standard.has(*group)));
        let all = costly.into_iter().fold(standard, PlaneGroups::with);
        assert_eq!(all, PlaneGroups::all());
    }
}
