// SPDX-License-Identifier: MIT
// Asio itself, compiled once for all sources of this library (BOOST_ASIO_SEPARATE_COMPILATION).
#include <boost/asio/impl/src.hpp>
