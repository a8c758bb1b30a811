//! Section 1, as far as `methods/tests` leaves anything to do: a ray along a lattice line of a field's own grid.

use horizon_field::field::{HeightImage, ImageField, ImageSource};
use horizon_field::march::{Anchored, Cast, Ray};
use horizon_field::{Compiled, Field, Place};

/// A wall, 10 m high, along z at x = 8.5; flat ground else. 64 texels of a metre, so that lattice lines, which join the
/// texels' centres, are at the half metres.
struct Wall;

impl ImageSource for Wall {
    fn load(&self, _: &str) -> Result<HeightImage, String> {
        let texels = (0..64 * 64).map(|i| if i % 64 == 40 { u16::MAX } else { 0 }).collect();
        Ok(HeightImage { width: 64, height: 64, texels })
    }
}

/// Where a ray enters a box, by the slab method: each axis' entry and exit by a multiplication with 1/d, as textbooks
/// have it for boxes of a grid or a pyramid. With d = 0 on a face of the box, 0 · ∞ is NaN.
fn slabs(ray: &Ray, low: [f64; 3], high: [f64; 3]) -> Option<f64> {
    let (mut enter, mut leave) = (0.0, f64::INFINITY);
    for axis in 0..3 {
        let inverse = 1.0 / ray.direction()[axis];
        let [a, b] = [low, high].map(|face| (face[axis] - ray.origin()[axis]) * inverse);
        let [near, far] = if a < b { [a, b] } else { [b, a] };
        enter = if near > enter { near } else { enter };
        leave = if far < leave { far } else { leave };
    }
    (enter <= leave).then_some(enter)
}

/// The nearest of the grid's boxes that a ray enters. Those left and right of the lattice line are both there.
fn naive(wall: &Compiled<2>, ray: &Ray) -> Option<f64> {
    let at = wall.anchor(&Place::ORIGIN);
    let cells = (0..63).flat_map(|j| (0..63).map(move |i| [f64::from(i) - 31.5, f64::from(j) - 31.5]));
    let entries = cells.filter_map(|[x, z]| {
        let top = wall.bound(&at, [x + 0.5, z + 0.5], [0.5; 2]).high;
        slabs(ray, [x, -1.0, z], [x + 1.0, top, z + 1.0])
    });
    entries.reduce(f64::min)
}

#[test]
fn a_ray_along_a_lattice_line_of_a_grid() {
    let image = ImageField { path: "wall".into(), size: [64.0; 2], low: 0.0, high: 10.0, ..ImageField::default() };
    let wall = Field::from(image).compile::<2>(&Wall).unwrap();
    let ground = Anchored::new(&wall, &Place::ORIGIN);
    let level = |z: f64| Ray::new([-20.0, 5.0, z], [1.0, 0.0, 0.0]).unwrap();
    let hit = |z: f64| match ground.cast(&level(z), 100.0) {
        Cast::Hit(hit) => hit.t,
        other => panic!("{other:?} at z = {z}"),
    };
    // A millimetre beside the line the naive way finds the wall; on it, all boxes are missed, left and right.
    assert!(naive(&wall, &level(0.501)).is_some_and(|t| t <= hit(0.501)));
    assert_eq!(naive(&wall, &level(0.5)), None, "the slab method must miss the wall");
    for z in [0.5, -0.5, 0.5 + 1e-12, 0.499, 0.501, 7.5] {
        assert!((hit(z) - hit(0.25)).abs() < 1e-9, "the wall is at {} m for z = {z}", hit(z));
    }
}
