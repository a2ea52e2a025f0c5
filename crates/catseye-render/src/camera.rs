//! Where a picture is taken from.

use glam::Vec3;

use crate::{Frame, Ray};

/// A pinhole or parallel projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    eye: Vec3,
    /// `z` is the viewing direction, `x` right, `y` down.
    frame: Frame,
    projection: Projection,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Projection {
    /// Half the picture's height at distance 1.
    Perspective { half_height: f32 },
    /// Half the picture's height in the scene.
    Orthographic { half_height: f32 },
}

impl Camera {
    /// A pinhole at `eye` that looks at `target`, its picture `vertical_fov` (radians, in `(0, pi)`) high.
    ///
    /// `up` is any direction that points upwards in the picture.
    #[must_use]
    pub fn perspective(eye: Vec3, target: Vec3, up: Vec3, vertical_fov: f32) -> Self {
        let projection = Projection::Perspective { half_height: (0.5 * vertical_fov).tan() };
        Self { eye, frame: looking(target - eye, up), projection }
    }

    /// A parallel projection whose picture shows `height` scene units; otherwise as [`Camera::perspective`].
    #[must_use]
    pub fn orthographic(eye: Vec3, target: Vec3, up: Vec3, height: f32) -> Self {
        let projection = Projection::Orthographic { half_height: 0.5 * height };
        Self { eye, frame: looking(target - eye, up), projection }
    }

    /// The ray through a point of the picture: `x` and `y` in pixels from the top left corner of a `size`
    /// picture.
    #[inline]
    #[must_use]
    pub fn ray(&self, [x, y]: [f32; 2], [width, height]: [f32; 2]) -> Ray {
        let (right, down) = ((2.0 * x - width) / height, (2.0 * y - height) / height);
        match self.projection {
            Projection::Perspective { half_height } => {
                let local = Vec3::new(right * half_height, down * half_height, 1.0);
                Ray::new(self.eye, self.frame.to_world(local).normalize())
            }
            Projection::Orthographic { half_height } => {
                let offset = Vec3::new(right * half_height, down * half_height, 0.0);
                Ray::new(self.eye + self.frame.to_world(offset), self.frame.z)
            }
        }
    }

    /// Where the camera stands, world space.
    #[must_use]
    pub fn eye(&self) -> Vec3 {
        self.eye
    }
}

/// The frame of a camera that looks along `direction`. A direction of length 0 looks along -z.
fn looking(direction: Vec3, up: Vec3) -> Frame {
    let z = direction.try_normalize().unwrap_or(Vec3::NEG_Z);
    Frame::from_normal_tangent(z, z.cross(up))
}
