//! The camera of a truth picture: pixel centres, and the grid of half pixels around them.

use crate::march::{Line, Ray};

/// How a camera maps directions to pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// A pinhole, with its vertical field of view in radians.
    Perspective {
        /// In radians, between 0 and π.
        fov: f64,
    },
    /// Parallel rays, from a window of this height.
    Orthographic {
        /// In metres.
        height: f64,
    },
}

/// A camera, in the coordinates of the surface that it looks at. Pixels are square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TruthCamera {
    /// The eye, in metres: x and z as the surface counts them, y is up. For parallel rays, the window's middle.
    pub position: [f64; 3],
    /// Where the camera's x axis points, of unit length.
    pub right: [f64; 3],
    /// Where the camera's y axis points, of unit length.
    pub up: [f64; 3],
    /// Where the camera looks, of unit length; Bevy's cameras look along their −z.
    pub forward: [f64; 3],
    /// The projection.
    pub projection: Projection,
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
}

impl TruthCamera {
    /// A camera at `position` that looks at `target`, with its horizon level, or with −z up where it looks straight
    /// down.
    pub fn looking_at(
        position: [f64; 3],
        target: [f64; 3],
        projection: Projection,
        [width, height]: [usize; 2],
    ) -> Self {
        let forward = unit([0, 1, 2].map(|axis| target[axis] - position[axis]));
        let across = cross(forward, [0.0, 1.0, 0.0]);
        let level = across.iter().any(|x| x.abs() > 1e-9);
        let right = if level { unit(across) } else { [1.0, 0.0, 0.0] };
        Self { position, right, up: cross(right, forward), forward, projection, width, height }
    }

    /// The ray through a point of the half-pixel grid, whose `[0, 0]` is the picture's top left corner; pixel (x, y)
    /// has its centre at `[2 x + 1, 2 y + 1]`.
    pub fn ray(&self, grid: [usize; 2]) -> Ray {
        let (origin, direction) = self.line(grid);
        Ray::new(origin, direction).expect("a camera's axes and position are finite")
    }

    /// The same, parametrised by depth along the camera's axis.
    pub(super) fn line(&self, grid: [usize; 2]) -> Line {
        // In half pictures: −1 at the left and at the bottom, 1 at the right and at the top.
        let x = grid[0] as f64 / self.width as f64 - 1.0;
        let y = 1.0 - grid[1] as f64 / self.height as f64;
        let aspect = self.width as f64 / self.height as f64;
        match self.projection {
            Projection::Perspective { fov } => {
                let tan = (0.5 * fov).tan();
                (self.position, self.offset(self.forward, x * tan * aspect, y * tan))
            }
            Projection::Orthographic { height } => {
                (self.offset(self.position, 0.5 * height * x * aspect, 0.5 * height * y), self.forward)
            }
        }
    }

    /// The cosine between a ray and the camera's axis: depth over distance.
    pub(super) fn cosine(&self, ray: &Ray) -> f64 {
        ray.direction().iter().zip(self.forward).map(|(a, b)| a * b).sum()
    }

    /// The ray through the centre of a pixel, counted row by row.
    pub fn pixel_ray(&self, index: usize) -> Ray {
        self.ray([2 * (index % self.width) + 1, 2 * (index / self.width) + 1])
    }

    /// How wide a pixel is at distance `t`, in metres, as it is in the middle of the picture.
    pub fn footprint(&self, t: f64) -> f64 {
        match self.projection {
            Projection::Perspective { fov } => t * 2.0 * (0.5 * fov).tan() / self.height as f64,
            Projection::Orthographic { height } => height / self.height as f64,
        }
    }

    fn offset(&self, from: [f64; 3], right: f64, up: f64) -> [f64; 3] {
        [0, 1, 2].map(|axis| from[axis] + right * self.right[axis] + up * self.up[axis])
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}
