! SPDX-License-Identifier: MIT
! Drives ahead and stops before what is in its way: in Fortran. brake.c does the same. The types are those of
! muro_controller.h.
module brake
  use, intrinsic :: iso_c_binding
  implicit none
  private
  public :: muro_controller

  type, bind(C) :: muro_port
    type(c_ptr) :: name, unit
    integer(c_int32_t) :: size, flags
  end type

  type, bind(C) :: muro_tunable
    type(c_ptr) :: name, unit
    real(c_double) :: default_value, min, max
    type(c_ptr) :: doc
  end type

  type, bind(C) :: muro_controller_step
    real(c_double) :: time
    type(c_ptr) :: inputs, outputs
    real(c_double) :: period
    integer(c_int64_t) :: index
    type(c_ptr) :: input_sizes, output_sizes, integer_inputs, text_inputs, integer_outputs, text_outputs
    type(c_ptr) :: tunables, log
  end type

  type, bind(C) :: muro_controller_table
    integer(c_int32_t) :: abi, table_size
    type(c_ptr) :: name, version, summary, inputs
    integer(c_int32_t) :: input_count
    type(c_ptr) :: outputs
    integer(c_int32_t) :: output_count
    integer(c_size_t) :: state_size
    type(c_funptr) :: create, step
    type(c_ptr) :: tunables
    integer(c_int32_t) :: tunable_count
    type(c_ptr) :: tasks
    integer(c_int32_t) :: task_count
    type(c_funptr) :: instantiate, destroy
    integer(c_size_t) :: save_size
    type(c_funptr) :: save, load
  end type

  ! The state between steps.
  type, bind(C) :: brake_state
    real(c_double) :: speed ! m/s, commanded last
  end type

  real(c_double), parameter :: acceleration = 0.5d0 ! m/s^2

  ! Texts of the table, which stay where they are.
  character(kind=c_char, len=6), target, save :: name = 'brake' // c_null_char, version = '1.0.0' // c_null_char
  character(kind=c_char, len=32), target, save :: summary = 'Stops before what is in its way' // c_null_char
  character(kind=c_char, len=7), target, save :: ranges = 'ranges' // c_null_char
  character(kind=c_char, len=14), target, save :: twist = 'command.twist' // c_null_char
  character(kind=c_char, len=2), target, save :: metres = 'm' // c_null_char
  character(kind=c_char, len=11), target, save :: metres_a_second = 'm/s, rad/s' // c_null_char
  character(kind=c_char, len=6), target, save :: speed_name = 'speed' // c_null_char
  character(kind=c_char, len=4), target, save :: speed_unit = 'm/s' // c_null_char
  character(kind=c_char, len=9), target, save :: distance_name = 'distance' // c_null_char

  type(muro_port), target, save :: inputs(1), outputs(1)
  type(muro_tunable), target, save :: tunables(2)
  type(muro_controller_table), target, save :: table

contains

  function step(block, now, error, error_size) result(code) bind(C, name='brake_step')
    type(c_ptr), value :: block, error
    type(muro_controller_step), intent(in) :: now
    integer(c_size_t), value :: error_size
    integer(c_int) :: code
    type(brake_state), pointer :: state
    type(c_ptr), pointer :: ports(:)
    integer(c_int32_t), pointer :: sizes(:)
    real(c_double), pointer :: scan(:), command(:), tunable(:)
    integer :: rays
    real(c_double) :: wanted

    call c_f_pointer(block, state)
    call c_f_pointer(now%input_sizes, sizes, [1])
    rays = sizes(1)
    call c_f_pointer(now%inputs, ports, [1])
    call c_f_pointer(ports(1), scan, [rays])
    call c_f_pointer(now%outputs, ports, [1])
    call c_f_pointer(ports(1), command, [6])
    call c_f_pointer(now%tunables, tunable, [2])

    wanted = minval(scan(rays / 3 + 1:rays - rays / 3)) - tunable(2)
    wanted = max(0d0, min(wanted, tunable(1)))
    state%speed = min(wanted, state%speed + acceleration * now%period)
    command(1) = state%speed
    code = 0
  end function

  function muro_controller() result(at) bind(C, name='muro_controller')
    type(c_ptr) :: at
    inputs(1) = muro_port(c_loc(ranges), c_loc(metres), 0, 0)
    outputs(1) = muro_port(c_loc(twist), c_loc(metres_a_second), 6, 0)
    tunables(1) = muro_tunable(c_loc(speed_name), c_loc(speed_unit), 0.5d0, 0.1d0, 2d0, c_null_ptr)
    tunables(2) = muro_tunable(c_loc(distance_name), c_loc(metres), 0.6d0, 0.1d0, 5d0, c_null_ptr)
    table = muro_controller_table(abi=1, table_size=int(c_sizeof(table), c_int32_t), name=c_loc(name), &
      version=c_loc(version), summary=c_loc(summary), inputs=c_loc(inputs), input_count=1, outputs=c_loc(outputs), &
      output_count=1, state_size=8, create=c_null_funptr, step=c_funloc(step), tunables=c_loc(tunables), &
      tunable_count=2, tasks=c_null_ptr, task_count=0, instantiate=c_null_funptr, destroy=c_null_funptr, &
      save_size=0, save=c_null_funptr, load=c_null_funptr)
    at = c_loc(table)
  end function

end module
