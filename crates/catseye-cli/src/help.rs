//! The examples that `--help` ends with, and the formats of the tables. A test runs every example.

/// Examples of `catseye render`.
pub(crate) const RENDER: &str = "\
Example:
  $ catseye render --size 320x180 --spp 4 -o night.png
  $ catseye render materials/retro_roughness_015.mtlx -o retro.exr";

/// Example of `catseye merge`.
pub(crate) const MERGE: &str = "\
Example:
  $ catseye render --size 320x180 --samples 0..4 -o a.exr
  $ catseye render --size 320x180 --samples 4..8 -o b.exr
  $ catseye merge a.exr b.exr --expect 0..8 -o night.png";

/// Example of `catseye furnace`.
pub(crate) const FURNACE: &str = "\
Example:
  $ catseye furnace --roughness 0.1 0.3 0.3,0.1 --spp 4 -o furnace.png";

/// Example of `catseye eval`.
pub(crate) const EVAL: &str = "\
Example:
  $ printf 'name,roughness_u,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z\\na,0.15,0,0,1,0,0,1\\n' | catseye eval
  name,roughness_u,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z,f_r,f_g,f_b,pdf
  a,0.15,0,0,1,0,0,1,7.153130497852406,7.153130497852406,7.153130497852406,7.153130497852406";

/// Example of `catseye sample`.
pub(crate) const SAMPLE: &str = "\
Example:
  $ printf 'roughness_u,wo_x,wo_y,wo_z,u1,u2,u3\\n0,0.6,0,0.8,0.1,0.2,0.3\\n' | catseye sample
  roughness_u,wo_x,wo_y,wo_z,u1,u2,u3,wi_x,wi_y,wi_z,weight_r,weight_g,weight_b,pdf,lobe
  0,0.6,0,0.8,0.1,0.2,0.3,0.6,0.0,0.8,1.0,1.0,1.0,1.0,dirac";

/// Example of `catseye albedo`.
pub(crate) const ALBEDO: &str = "\
Example:
  $ printf 'roughness_u,wo_x,wo_y,wo_z\\n1,0,0,1\\n' | catseye albedo
  roughness_u,wo_x,wo_y,wo_z,albedo_r,albedo_g,albedo_b
  1,0,0,1,0.3553233343868754,0.3553233343868754,0.3553233343868754";

/// Example of `catseye standards`.
pub(crate) const STANDARDS: &str = "\
Example:
  $ catseye standards list iso20471
  ISO 20471
    Intertraffic World 2020 p. 172, journal-download.co.uk/digitalmagazines/ITW/ITW01NOV2019/page_172.html
    iso20471:separate:white  16 x R_A minimum at observation 0.2 0.333 1 1.5, entrance 5 20 30 40";

/// Example of `catseye standards list`.
pub(crate) const STANDARDS_LIST: &str = STANDARDS;

/// Example of `catseye standards show`.
pub(crate) const STANDARDS_SHOW: &str = "\
Example:
  $ catseye standards show ansi-107:level-2 | cut -d, -f1-11
  id,standard,revision,class,colour,observation_deg,entrance_deg,quantity,value,unit,limit
  ansi-107:level-2:white,ANSI/ISEA 107,not stated,Level 2,white (silver),0.2,5,R_A,330,cd/lx/m2,minimum";

/// Example of `catseye roughness`.
pub(crate) const ROUGHNESS: &str = "\
Example:
  $ catseye roughness --half-power-deg 0.4 --ra 250 --at-deg 0.2
  roughness         0.00592964
  half-power angle  0.4 deg (full width 0.8 deg)
  tint              0.0656788
  peak R_A          297.301 cd/lx/m2";

const MEASURE: &str = "\
Example:
  $ catseye measure materials/sheeting.mtlx --standard fmvss108:dot-c2:white
  $ catseye measure materials/sheeting.mtlx --verdict
  $ catseye measure materials/sheeting.mtlx --verdict --standard fmvss108:dot-c3:white --guard 3%
  $ catseye measure materials/sheeting.mtlx --standard fmvss108:dot-c2:white --instrument";

const VALUES: &str = "\
Table format:
  A header line, then one row per geometry or value; columns in any order:
    observation_deg   between source and receiver, in [0, 180)
    entrance_deg      between source and surface normal (beta_1), in (-90, 90);
                      above 0 the normal is tipped towards the receiver
    beta_2_deg        across it, in (-90, 90) [default: 0]
    rotation_deg      of the sample about its normal, in [-360, 360] [default: 0]
    quantity          R_A, R_L, R_I, R_Phi, R_T, Q_d, Y or f [default: by the unit]
    unit              cd/lx/m2, mcd/lx/m2, cd/fc/ft2, cd/lx, mcd/lx, cd/fc, 1/sr,
                      1 or % [default: the quantity's, or cd/lx/m2]
    value             needed where values are compared
    uncertainty       one standard deviation, in the unit or as 3% of the value
    limit             minimum, maximum or typical
    wavelength_nm     where it was not white light
    source_aperture_deg, receiver_aperture_deg
                      full angles of the instrument's apertures
    standard, class, colour, source
  - Data sheets are read as they come: `,`, `;`, `|` or tabs between columns,
    decimal commas, names in any case and their synonyms (obs, alpha, ent, beta,
    beta_1, R_A, SIA, ...), units behind a name: R_A [cd/lx/m2], alpha (deg).
  - Angles are minutes of arc where the name or the cell says so: observation_min,
    alpha ('), 12'.
  - Other columns are carried through; one named model is replaced.
  - An empty cell is a missing one.
  - A bad row is an error that names line and column; nothing is printed then.";

/// Examples of `catseye export`.
pub(crate) const EXPORT: &str = "\
Example:
  $ catseye export radiance materials/tape_fmvss108_c2_white.mtlx -o tape.rad
  wrote tape.rad and tape.cal
  R_A in the lobe, from its peak to a tenth: within 0.01 % at all 20 values
  $ catseye export csv astm-d4956:iii:white -o iii.csv
  $ catseye export gltf materials/tape_fmvss108_c2_white.mtlx --entrances -4,5,20 -o tape.gltf
  $ catseye export openmaterial materials/sheeting.mtlx --tint 905=0.3 -o sheeting.xomp";

/// Example of `catseye optics`.
pub(crate) const OPTICS: &str = "\
Example:
  $ catseye optics cube -o cube.csv
  wrote cube.csv (32 values)
  $ catseye plot ra materials/sheeting.mtlx --standard cube.csv -o cube.svg
  wrote cube.svg (960 x 640)";

/// Example of `catseye optics bead`.
pub(crate) const OPTICS_BEAD: &str = "\
Example:
  $ catseye optics bead --observation 0.2,0.5 --entrance 5 | cut -d, -f1-5";

/// Example of `catseye optics cube`.
pub(crate) const OPTICS_CUBE: &str = "\
Example:
  $ catseye optics cube --observation 0.2 --entrance 30 --rotation 0,30 | cut -d, -f1-6";

/// The format of tables of values, and an example of `catseye measure`.
pub(crate) fn measure() -> String {
    format!("{VALUES}\n\n{MEASURE}")
}

/// Example of `catseye completions`.
pub(crate) const COMPLETIONS: &str = "\
Example:
  $ catseye completions bash > catseye.bash";

/// Example of `catseye man`.
pub(crate) const MAN: &str = "\
Example:
  $ catseye man plot lobe > catseye-plot-lobe.1";

/// Example of `catseye plot`.
pub(crate) const PLOT: &str = "\
Example:
  $ catseye plot lobe --roughness 0.3 -o lobe.svg
  wrote lobe.svg (916 x 369)";

/// Example of `catseye plot lobe`.
pub(crate) const PLOT_LOBE: &str = "\
Example:
  $ catseye plot lobe --roughness 0.15 --theta 0,45,75 --axes cartesian -o lobe.png
  wrote lobe.png (1832 x 738)";

/// Example of `catseye plot albedo`.
pub(crate) const PLOT_ALBEDO: &str = "\
Example:
  $ catseye plot albedo --roughness 0.1 0.5 1 inf -o albedo.svg
  wrote albedo.svg (960 x 640)";

/// Example of `catseye plot spheres`.
pub(crate) const PLOT_SPHERES: &str = "\
Example:
  $ catseye plot spheres --roughness 0.15 -o spheres.png";

/// Example of `catseye plot optics`.
pub(crate) const PLOT_OPTICS: &str = "\
Example:
  $ catseye plot optics -o optics.svg
  wrote optics.svg (1140 x 560)";

/// The format of tables of values, and examples of `catseye fit`.
pub(crate) fn fit() -> String {
    format!("{VALUES}\n\n{FIT}")
}

const FIT: &str = "\
Example:
  $ catseye fit astm-d4956:iii:white --luminance-factor 0.27 -o sign.mtlx --report sign.html
  $ catseye standards show fra-224:white > sheet.csv
  $ catseye fit sheet.csv -o sheet.mtlx";

/// Example of `catseye plot ra`.
pub(crate) const PLOT_RA: &str = "\
Example:
  $ catseye plot ra --roughness 0.0057 --tint 0.063 --standard astm-d4956:iii:white -o ra.svg
  wrote ra.svg (960 x 640)
  $ catseye plot ra materials/sheeting.mtlx --standard fmvss108:dot-c2:white -o sheeting.png";

/// Example of `catseye materialx`.
pub(crate) const MATERIALX: &str = "\
Example:
  $ catseye materialx export nodes
  wrote nodes/libraries/catseye";

/// Example of `catseye materialx export`.
pub(crate) const MATERIALX_EXPORT: &str = MATERIALX;

/// Example of `catseye materialx check`.
pub(crate) const MATERIALX_CHECK: &str = "\
Example:
  $ catseye materialx check materials/sheeting.mtlx
  materials/sheeting.mtlx: no problems";

const TABLE: &str = "\
Table format:
  A header line, then one row per query; columns in any order. Inputs:
    roughness_u                      in [0, inf]; `inf` is legal
    roughness_v                      [default: as roughness_u]
    tint_r, tint_g, tint_b           in [0, 1] [default: 1]
    multiscatter_tint_r, _g, _b      in [0, 1] [default: 0]
    wo_x, wo_y, wo_z                 direction towards the viewer
    wi_x, wi_y, wi_z                 direction towards the light (eval)
    u1, u2, u3                       uniform numbers in [0, 1) (sample)
  - Directions are unit vectors (within 0.001; their length is made 1) that point
    away from the surface; z is the shading normal, x the tangent.
  - Capitals in the header don't matter. An empty cell is a missing one.
  - Other columns are carried through; one that has the name of an added
    column is replaced. A warning names those that look like an input's.
  - Numbers are printed with the digits that give the same value back.
  - A bad row is an error that names line and column; nothing is printed then.";

/// An example after the format of the tables.
pub(crate) fn table(example: &str) -> String {
    format!("{TABLE}\n\n{example}")
}

/// Examples of `catseye drive`.
pub(crate) const DRIVE: &str = "\
Example:
  $ catseye drive materials/sheeting.mtlx astm-d4956:iii:white --distance-m 200,100,50
  $ catseye drive materials/sheeting.mtlx --vehicle truck --sign overhead --csv -o truck.csv
  $ catseye drive materials/sheeting.mtlx astm-d4956:iii:white --required 2.4 --plot drive.svg
  wrote drive.svg (960 x 600)";

/// Examples of `catseye lidar`.
pub(crate) const LIDAR: &str = "\
Example:
  $ catseye lidar materials/sheeting.mtlx --observation-deg 0.1 --tint 905=0.6 --csv -o lidar.csv
  $ catseye lidar astm-d4956:iii:white --spacing-mm 60 --distance-m 20 --tint 905=0.6
  $ catseye lidar fra-224:white --observation-deg 0.3 --entrance-deg 5 --tint 905=0.6 --sdf";
