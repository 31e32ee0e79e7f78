// SPDX-License-Identifier: MIT
//! Drives ahead and stops before what is in its way: in Rust. brake.c does the same. The types are those of
//! muro_controller.h.
use std::os::raw::{c_char, c_int, c_void};

#[repr(C)]
struct Port {
    name: *const c_char,
    unit: *const c_char,
    size: u32,
    flags: u32,
}

#[repr(C)]
struct Tunable {
    name: *const c_char,
    unit: *const c_char,
    default_value: f64,
    min: f64,
    max: f64,
    doc: *const c_char,
}

#[repr(C)]
struct Step {
    time: f64,
    inputs: *const *const f64,
    outputs: *const *mut f64,
    period: f64,
    index: u64,
    input_sizes: *const u32,
    output_sizes: *const u32,
    integer_inputs: *const *const i64,
    text_inputs: *const *const c_char,
    integer_outputs: *const *mut i64,
    text_outputs: *const *mut c_char,
    tunables: *const f64,
    log: *const c_void,
}

/// A function that this controller does without.
type Absent = Option<unsafe extern "C" fn()>;

#[repr(C)]
pub struct Table {
    abi: u32,
    table_size: u32,
    name: *const c_char,
    version: *const c_char,
    summary: *const c_char,
    inputs: *const Port,
    input_count: u32,
    outputs: *const Port,
    output_count: u32,
    state_size: usize,
    create: Absent,
    step: unsafe extern "C" fn(*mut c_void, *const Step, *mut c_char, usize) -> c_int,
    tunables: *const Tunable,
    tunable_count: u32,
    tasks: *const c_void,
    task_count: u32,
    instantiate: Absent,
    destroy: Absent,
    save_size: usize,
    save: Absent,
    load: Absent,
}
// its pointers lead to constants
unsafe impl Sync for Table {}
unsafe impl Sync for Port {}
unsafe impl Sync for Tunable {}

/// The state between steps, in a block that muro keeps.
#[repr(C)]
struct Brake {
    speed: f64, // m/s, commanded last
}

const ACCELERATION: f64 = 0.5; // m/s^2

impl Brake {
    /// The speed for this step, m/s.
    fn drive(&mut self, ranges: &[f64], speed: f64, distance: f64, period: f64) -> f64 {
        let third = ranges.len() / 3;
        let nearest = ranges[third..ranges.len() - third].iter().copied().fold(f64::INFINITY, f64::min);
        let wanted = (nearest - distance).min(speed).max(0.0);
        self.speed = wanted.min(self.speed + ACCELERATION * period);
        self.speed
    }
}

unsafe extern "C" fn step(state: *mut c_void, now: *const Step, _error: *mut c_char, _error_size: usize) -> c_int {
    let (brake, now) = (&mut *state.cast::<Brake>(), &*now);
    let ranges = std::slice::from_raw_parts(*now.inputs, *now.input_sizes as usize);
    let tunables = std::slice::from_raw_parts(now.tunables, 2);
    **now.outputs = brake.drive(ranges, tunables[0], tunables[1], now.period);
    0
}

/// As C has it; the bytes end with a zero.
const fn text(bytes: &'static [u8]) -> *const c_char {
    bytes.as_ptr() as *const c_char
}

static INPUTS: [Port; 1] = [Port { name: text(b"ranges\0"), unit: text(b"m\0"), size: 0, flags: 0 }];
static OUTPUTS: [Port; 1] =
    [Port { name: text(b"command.twist\0"), unit: text(b"m/s, rad/s\0"), size: 6, flags: 0 }];
static TUNABLES: [Tunable; 2] = [
    Tunable {
        name: text(b"speed\0"),
        unit: text(b"m/s\0"),
        default_value: 0.5,
        min: 0.1,
        max: 2.0,
        doc: text(b"on a free way\0"),
    },
    Tunable {
        name: text(b"distance\0"),
        unit: text(b"m\0"),
        default_value: 0.6,
        min: 0.1,
        max: 5.0,
        doc: text(b"from the obstacle before which it stops\0"),
    },
];
static TABLE: Table = Table {
    abi: 1,
    table_size: std::mem::size_of::<Table>() as u32,
    name: text(b"brake\0"),
    version: text(b"1.0.0\0"),
    summary: text(b"Stops before what is in its way\0"),
    inputs: INPUTS.as_ptr(),
    input_count: 1,
    outputs: OUTPUTS.as_ptr(),
    output_count: 1,
    state_size: std::mem::size_of::<Brake>(),
    create: None,
    step,
    tunables: TUNABLES.as_ptr(),
    tunable_count: 2,
    tasks: std::ptr::null(),
    task_count: 0,
    instantiate: None,
    destroy: None,
    save_size: 0,
    save: None,
    load: None,
};

#[no_mangle]
pub extern "C" fn muro_controller() -> *const Table {
    &TABLE
}
