//! The examples and the table format that `--help` ends with.

/// Example of `catseye eval`.
pub(crate) const EVAL: &str = "\
Example:
  $ printf 'roughness_u,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z\\n0.15,0,0,1,0,0,1\\n' | catseye eval
  roughness_u,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z,f_r,f_g,f_b,pdf
  0.15,0,0,1,0,0,1,7.153...";

/// Example of `catseye sample`.
pub(crate) const SAMPLE: &str = "x";

/// Example of `catseye albedo`.
pub(crate) const ALBEDO: &str = "x";

/// An example followed by the format of the tables.
pub(crate) fn table(example: &str) -> String {
    example.to_owned()
}
