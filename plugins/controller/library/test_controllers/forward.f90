! SPDX-License-Identifier: MIT
! A controller in Fortran: drives ahead at 0.5 m/s. Its types are those of muro_controller.h.
module forward
  use, intrinsic :: iso_c_binding
  implicit none

  type, bind(C) :: muro_port
    type(c_ptr) :: name, unit
    integer(c_int32_t) :: size, flags
  end type

  type, bind(C) :: muro_controller_step
    real(c_double) :: time
    type(c_ptr) :: inputs, outputs
  end type

  type, bind(C) :: muro_controller_table
    integer(c_int32_t) :: abi, table_size
    type(c_ptr) :: name, version, summary
    type(c_ptr) :: inputs
    integer(c_int32_t) :: input_count
    type(c_ptr) :: outputs
    integer(c_int32_t) :: output_count
    integer(c_size_t) :: state_size
    type(c_funptr) :: create, step
  end type

  character(kind=c_char), target :: name(8) = ['f', 'o', 'r', 'w', 'a', 'r', 'd', c_null_char]
  character(kind=c_char), target :: version(6) = ['1', '.', '0', '.', '0', c_null_char]
  character(kind=c_char), target :: twist(14) = &
    ['c', 'o', 'm', 'm', 'a', 'n', 'd', '.', 't', 'w', 'i', 's', 't', c_null_char]
  type(muro_port), target, save :: outputs(1)
  type(muro_controller_table), target, save :: table

contains

  function step(state, now, error, error_size) result(code) bind(C, name='step')
    type(c_ptr), value :: state, error
    type(muro_controller_step), intent(in) :: now
    integer(c_size_t), value :: error_size
    integer(c_int) :: code
    type(c_ptr), pointer :: ports(:)
    real(c_double), pointer :: command(:)
    call c_f_pointer(now%outputs, ports, [1])
    call c_f_pointer(ports(1), command, [6])
    command(1) = 0.5d0
    code = 0
  end function

  function muro_controller() result(at) bind(C, name='muro_controller')
    type(c_ptr) :: at
    outputs(1) = muro_port(c_loc(twist), c_null_ptr, 6, 0)
    table = muro_controller_table(abi=1, table_size=int(c_sizeof(table), c_int32_t), name=c_loc(name), &
      version=c_loc(version), summary=c_loc(name), inputs=c_null_ptr, input_count=0, outputs=c_loc(outputs), &
      output_count=1, state_size=0, create=c_null_funptr, step=c_funloc(step))
    at = c_loc(table)
  end function

end module
