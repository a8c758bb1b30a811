//! The ways to find the plant that a ray meets.

use horizon_field::Place;
use horizon_field::march::Ray;
use horizon_field::trees::{Cone, Distance, Grove, NineCells, PlantWork};

use super::woods::Sight;
use crate::march::OURS;

/// Seed 000's search, which computes at every step where its nine plants stand.
pub const NINE: &str = "nine cells";

/// The same, with our cache of plants.
pub const NINE_CACHED: &str = "nine cells, our cache";

/// The settings of ours that are like the rivals': all search the same stretch of a ray.
pub const LIKE: &str = "from the canopy";

/// Where a search begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// At the camera.
    Camera,
    /// Where the ray first enters the canopy. What finds that place is not counted.
    Canopy,
    /// Where the ray enters the canopy for the last time before it meets the ground, as seed 000 has it: rays that meet none
    /// are not searched.
    LastCanopy,
}

/// A way to find the plant that a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Search {
    /// The walk through the dual cells.
    Dual(Start),
    /// Sphere tracing through repeated cells.
    Cells(NineCells, Start),
}

/// All of them, with their settings: ours, also from the camera on; seed 000's as printed, with what is wrong with its placement
/// put right, and the same with our cache of plants; sphere tracing of the whole domain by a distance that is a bound.
pub fn all(quick: bool) -> Vec<Search> {
    let mut all = vec![Search::Dual(Start::Canopy), Search::Dual(Start::Camera)];
    for near in [0.25, 0.002] {
        all.push(Search::Cells(NineCells { near, ..NineCells::SURE }, Start::Camera));
    }
    for pace in [1.0, 0.5, 0.25] {
        all.push(Search::Cells(NineCells { pace, ..NineCells::PRINTED }, Start::LastCanopy));
    }
    for distance in [Distance::Printed, Distance::Estimate, Distance::Bound] {
        for pace in [1.0, 0.7, 0.5] {
            for near in [0.25, 0.02, 0.002] {
                let search = NineCells { distance, shared: false, pace, near, ..NineCells::PRINTED };
                all.push(Search::Cells(search, Start::Canopy));
                all.push(Search::Cells(NineCells { forgetful: true, ..search }, Start::Canopy));
            }
        }
    }
    if quick { all.into_iter().step_by(3).collect() } else { all }
}

impl Search {
    /// Its name.
    pub fn method(&self) -> &'static str {
        match self {
            Self::Dual(_) => OURS,
            Self::Cells(NineCells { shared: true, .. }, _) => "nine cells, as printed",
            Self::Cells(NineCells { forgetful: true, .. }, _) => NINE,
            Self::Cells(NineCells { limited: false, .. }, _) => NINE_CACHED,
            Self::Cells(..) => "sphere tracing",
        }
    }

    /// Its settings.
    pub fn settings(&self) -> String {
        match self {
            Self::Dual(Start::Camera) => "from the camera".into(),
            Self::Dual(_) => LIKE.into(),
            Self::Cells(NineCells { distance, pace, near, .. }, _) => {
                let distance = match distance {
                    Distance::Printed => "radii",
                    Distance::Estimate => "estimate",
                    Distance::Bound => "bound",
                };
                format!("distance={distance} pace={pace} near={near}")
            }
        }
    }

    /// Where it has it that a ray meets a plant.
    pub fn cast(&self, grove: &mut Grove<'_>, sight: &Sight, cone: Cone, work: &mut PlantWork) -> Option<f64> {
        let (Self::Dual(start) | Self::Cells(_, start)) = self;
        let from = match start {
            Start::Camera => 0.0,
            Start::Canopy => sight.nearest,
            Start::LastCanopy if sight.ground => sight.farthest,
            Start::LastCanopy => return None,
        };
        let ray = Ray::new(sight.ray.at(from), sight.ray.direction()).expect("a ray goes on as it began");
        let cone = Cone { start: cone.start + cone.growth * from, ..cone };
        let met = match self {
            Self::Dual(_) => grove.cast_as::<f64>(&Place::ORIGIN, &ray, sight.end - from, cone, work).map(|hit| hit.t),
            Self::Cells(search, _) => search.cast(grove, &Place::ORIGIN, &ray, sight.end - from, cone, work),
        };
        met.map(|t| from + t)
    }
}
