//! The options that say where vehicle, road, sign and lamps are.

use std::path::Path;

use anyhow::bail;
use catseye_photometry::drive::{Road, Scene, Sign, Vehicle};
use catseye_photometry::lamp::{Axis, Lamp};
use catseye_photometry::{Error, significant};
use clap::ValueEnum;

use crate::failure::Usage;

/// The name of the built-in lamp.
const BUILT_IN: &str = "fmvss108";

/// Vehicles whose sizes come with the command.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum VehicleName {
    /// Lamps 0.62 m high and 1.12 m apart, eye 1.11 m high, 0.35 m left, 1.8 m behind (assumed)
    #[default]
    Car,
    /// Lamps 0.83 m high and 1.30 m apart, eye 1.42 m high, 0.37 m left, 1.9 m behind (assumed)
    Van,
    /// Lamps 0.98 m high and 1.80 m apart, eye 2.33 m high, 0.55 m left, 1.7 m behind (assumed)
    Truck,
}

/// Where signs usually are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Position {
    /// 5.5 m to the right of the middle of the lane, 2.5 m high
    #[default]
    Shoulder,
    /// Above the middle of the lane, 6.5 m high
    Overhead,
}

/// As [`Axis`], by names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum AxisName {
    /// Gamma 0 is straight ahead, C0 to the right, C90 up
    Ahead,
    /// Gamma 0 is straight down, C0 ahead, C90 to the left
    Down,
}

/// Vehicle, road, sign and lamps.
#[derive(Debug, clap::Args)]
pub(super) struct SettingArgs {
    /// Vehicle; the options below replace single sizes
    #[arg(long, value_enum, default_value_t, help_heading = "Vehicle")]
    vehicle: VehicleName,
    /// Height of the headlamps above the road
    #[arg(long, value_name = "M", help_heading = "Vehicle")]
    lamp_height_m: Option<f64>,
    /// Distance between the headlamps
    #[arg(long, value_name = "M", help_heading = "Vehicle")]
    lamp_spacing_m: Option<f64>,
    /// Height of the driver's eye above the road
    #[arg(long, value_name = "M", help_heading = "Vehicle")]
    eye_height_m: Option<f64>,
    /// How far the eye is to the left of the vehicle's middle; negative to the right
    #[arg(long, value_name = "M", help_heading = "Vehicle")]
    eye_left_m: Option<f64>,
    /// How far the eye is behind the headlamps
    #[arg(long, value_name = "M", help_heading = "Vehicle")]
    eye_behind_m: Option<f64>,

    /// Radius of the road's curve: positive to the left, negative to the right
    #[arg(long, value_name = "M", help_heading = "Road and sign", conflicts_with_all = ["dip_m", "crest_m"])]
    curve_m: Option<f64>,
    /// Radius of a dip with the vehicle at its bottom
    #[arg(long, value_name = "M", help_heading = "Road and sign", conflicts_with = "crest_m")]
    dip_m: Option<f64>,
    /// Radius of a crest with the vehicle on its top
    #[arg(long, value_name = "M", help_heading = "Road and sign")]
    crest_m: Option<f64>,
    /// Where the sign is; the options below replace single lengths
    #[arg(long, value_enum, default_value_t, help_heading = "Road and sign")]
    sign: Position,
    /// How far the sign is to the right of the middle of the lane; negative to the left
    #[arg(long, value_name = "M", help_heading = "Road and sign")]
    right_m: Option<f64>,
    /// Height of the sign's middle above the road
    #[arg(long, value_name = "M", help_heading = "Road and sign")]
    height_m: Option<f64>,
    /// How far the sign leans back, to face the sky
    #[arg(long, value_name = "DEG", default_value_t = 0.0, help_heading = "Road and sign")]
    tilt_deg: f64,
    /// How far the sign's face is turned to the driver's left
    #[arg(long, value_name = "DEG", default_value_t = 0.0, help_heading = "Road and sign")]
    yaw_deg: f64,
    /// How far the sheeting is turned counter-clockwise on the sign, seen from the front
    #[arg(long, value_name = "DEG", default_value_t = 0.0, help_heading = "Road and sign")]
    turn_deg: f64,
    /// Distances along the road from the headlamps to the sign
    #[arg(long, value_name = "M,...", value_delimiter = ',', help_heading = "Road and sign")]
    #[arg(default_value = "300,250,200,150,120,100,80,60,50,40,30,20")]
    pub(super) distance_m: Vec<f64>,

    /// Headlamp: an IES LM-63 or EULUMDAT (.ldt) file, a number of candela in all directions, or `fmvss108`,
    /// a lower beam just bright enough for the test points of FMVSS 108
    #[arg(long, value_name = "FILE|CD|fmvss108", default_value = BUILT_IN, help_heading = "Lamps")]
    lamp: String,
    /// What the angles of a file of Type C or EULUMDAT are counted from
    #[arg(long, value_enum, help_heading = "Lamps")]
    lamp_axis: Option<AxisName>,
    /// Factor of the lamp's intensities
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, help_heading = "Lamps")]
    lamp_factor: f64,
    /// How far the lamps are aimed to the right
    #[arg(long, value_name = "DEG", default_value_t = 0.0, help_heading = "Lamps")]
    aim_right_deg: f64,
    /// How far the lamps are aimed upwards; negative downwards
    #[arg(long, value_name = "DEG", default_value_t = 0.0, help_heading = "Lamps")]
    aim_up_deg: f64,
    /// Share of the light that the windscreen lets through
    #[arg(long, value_name = "SHARE", default_value_t = 1.0, help_heading = "Lamps")]
    windscreen: f64,
}

impl SettingArgs {
    /// The places of everything.
    pub(super) fn scene(&self) -> Scene {
        let usual = match self.vehicle {
            VehicleName::Car => Vehicle::CAR,
            VehicleName::Van => Vehicle::VAN,
            VehicleName::Truck => Vehicle::TRUCK,
        };
        let vehicle = Vehicle {
            lamp_height_m: self.lamp_height_m.unwrap_or(usual.lamp_height_m),
            lamp_spacing_m: self.lamp_spacing_m.unwrap_or(usual.lamp_spacing_m),
            eye_height_m: self.eye_height_m.unwrap_or(usual.eye_height_m),
            eye_left_m: self.eye_left_m.unwrap_or(usual.eye_left_m),
            eye_behind_m: self.eye_behind_m.unwrap_or(usual.eye_behind_m),
        };
        let curve = self.curve_m.map(|radius_m| Road::Curve { radius_m });
        let dip = self.dip_m.map(|radius_m| Road::Dip { radius_m });
        let crest = self.crest_m.map(|radius_m| Road::Dip { radius_m: -radius_m });
        let usual = match self.sign {
            Position::Shoulder => Sign::SHOULDER,
            Position::Overhead => Sign::OVERHEAD,
        };
        let sign = Sign {
            right_m: self.right_m.unwrap_or(usual.right_m),
            height_m: self.height_m.unwrap_or(usual.height_m),
            tilt_deg: self.tilt_deg,
            yaw_deg: self.yaw_deg,
            turn_deg: self.turn_deg,
        };
        Scene { vehicle, road: curve.or(dip).or(crest).unwrap_or(Road::Straight), sign }
    }

    /// The headlamp, aimed; the windscreen is in front of the eye, which is the same to the luminance.
    pub(super) fn lamp(&self) -> anyhow::Result<Lamp> {
        for (name, value, most) in
            [("lamp-factor", self.lamp_factor, 1e6), ("windscreen", self.windscreen, 1.0)]
        {
            if !(value > 0.0 && value <= most) {
                bail!(Usage(format!("--{name} {value}: must be above 0 and at most {most}")));
            }
        }
        for (name, value) in [("aim-right-deg", self.aim_right_deg), ("aim-up-deg", self.aim_up_deg)] {
            if !(value.abs() <= 45.0) {
                bail!(Usage(format!("--{name} {value}: must be from -45 to 45")));
            }
        }
        let axis = self.lamp_axis.map(|axis| match axis {
            AxisName::Ahead => Axis::Ahead,
            AxisName::Down => Axis::Down,
        });
        let lamp = match self.lamp.parse::<f64>() {
            Ok(candela) if candela > 0.0 && candela <= 1e9 => Lamp::even(candela),
            Ok(candela) => bail!(Usage(format!("--lamp {candela}: must be above 0 and at most 1e9 cd"))),
            Err(_) if self.lamp == BUILT_IN => Lamp::low_beam(),
            Err(_) => match Lamp::read(Path::new(&self.lamp), axis) {
                Err(error @ Error::LampAxis { .. }) => bail!("{error}, with --lamp-axis"),
                read => read?,
            },
        };
        Ok(lamp.aimed(self.aim_right_deg, self.aim_up_deg).times(self.lamp_factor))
    }

    /// The share of light that reaches the eye through the windscreen.
    pub(super) fn windscreen(&self) -> f64 {
        self.windscreen
    }

    /// The scene in a line.
    pub(super) fn title(&self) -> String {
        let vehicle = match self.vehicle {
            VehicleName::Car => "car",
            VehicleName::Van => "van",
            VehicleName::Truck => "truck",
        };
        let Scene { road, sign, .. } = self.scene();
        let meters = |length: f64| format!("{} m", significant(length.abs(), 4));
        let road = match road {
            Road::Straight => "straight road".to_owned(),
            Road::Curve { radius_m } if radius_m > 0.0 => {
                format!("curve of {} to the left", meters(radius_m))
            }
            Road::Curve { radius_m } => format!("curve of {} to the right", meters(radius_m)),
            Road::Dip { radius_m } if radius_m > 0.0 => format!("dip of {}", meters(radius_m)),
            Road::Dip { radius_m } => format!("crest of {}", meters(radius_m)),
        };
        let side = match sign.right_m {
            0.0 => "above the lane".to_owned(),
            right if right < 0.0 => format!("{} to the left", meters(right)),
            right => format!("{} to the right", meters(right)),
        };
        let sign = format!("sign {side}, {} high", meters(sign.height_m));
        let lamp = match self.lamp.parse::<f64>() {
            Ok(candela) => format!("lamps of {} cd", significant(candela, 6)),
            Err(_) if self.lamp == BUILT_IN => "lower beams of FMVSS 108's minima".to_owned(),
            Err(_) => format!("lamps of {}", self.lamp),
        };
        let factor = if self.lamp_factor == 1.0 { String::new() } else { format!(" x {}", self.lamp_factor) };
        format!("{vehicle}, {road}, {sign}, {lamp}{factor}")
    }
}
