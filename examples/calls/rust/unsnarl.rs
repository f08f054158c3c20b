//! A repair by the C library, libunsnarl_c.
use std::ffi::{CStr, CString};
use std::os::raw::{c_char, c_int, c_void};
use std::{mem::size_of, ptr, ptr::null_mut};

// The first fields of the structs of unsnarl.h; their size says where they end.
#[repr(C)]
struct Surface {
    size: usize,
    positions: *const f64,
    vertex_count: usize,
    corners: *const i32,
    corner_count: usize,
}
#[repr(C)]
struct Options {
    size: usize,
    weld: *const c_char,
    weld_tolerance: f64,
    both_diagonals: i32,
    threads: i32,
    goal: *const c_char,
    precision: *const c_char,
    min_gap: f64,
    max_displacement: f64,
    absolute: i32,
}
#[repr(C)]
struct Array {
    data: *const c_void,
    rows: usize,
    columns: usize,
    kind: c_int,
}
#[link(name = "unsnarl_c")]
extern "C" {
    fn unsnarl_options_init(options: *mut Options, size: usize) -> c_int;
    fn unsnarl_repair(s: *const Surface, o: *const Options, context: *mut c_void, result: *mut *mut c_void) -> c_int;
    fn unsnarl_result_array(result: *const c_void, name: *const c_char, array: *mut Array) -> c_int;
    fn unsnarl_result_status(result: *const c_void) -> *const c_char;
    fn unsnarl_result_free(result: *mut c_void);
    fn unsnarl_error_message() -> *const c_char;
}

fn text(from: *const c_char) -> String {
    unsafe { CStr::from_ptr(from).to_string_lossy().into_owned() }
}

fn checked(code: c_int) -> Result<(), String> {
    if code == 0 { Ok(()) } else { Err(text(unsafe { unsnarl_error_message() })) }
}

/// positions: x y z of each vertex; corners: three vertices a face, from 0; precision: "auto", "float32" or "float64".
/// Gives the new positions and the status: "embedded" where no self-intersection is left.
pub fn repair(positions: &[f64], corners: &[i32], precision: &str) -> Result<(Vec<f64>, String), String> {
    let surface = Surface {
        size: size_of::<Surface>(),
        positions: positions.as_ptr(),
        vertex_count: positions.len() / 3,
        corners: corners.as_ptr(),
        corner_count: corners.len(),
    };
    let precision = CString::new(precision).map_err(|e| e.to_string())?;
    unsafe {
        let mut options: Options = std::mem::zeroed();
        checked(unsnarl_options_init(&mut options, size_of::<Options>()))?;
        options.precision = precision.as_ptr();
        let mut result = null_mut();
        checked(unsnarl_repair(&surface, &options, null_mut(), &mut result))?;
        let mut moved: Array = std::mem::zeroed();
        let found = checked(unsnarl_result_array(result, b"positions\0".as_ptr().cast(), &mut moved));
        let repaired = found.map(|()| {
            let mut numbers = vec![0.0; moved.rows * moved.columns];
            if !numbers.is_empty() {
                ptr::copy_nonoverlapping(moved.data.cast(), numbers.as_mut_ptr(), numbers.len());
            }
            (numbers, text(unsnarl_result_status(result)))
        });
        unsnarl_result_free(result);
        repaired
    }
}
