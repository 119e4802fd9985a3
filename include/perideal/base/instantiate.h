// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_instantiate_h
#define perideal_base_instantiate_h

namespace perideal
{
  /// Keeps a function in the object file that instantiates this: a template that the linker must find is
  /// compiled where its address is taken.
  template <auto function>
  struct Instance
  {
    static const decltype(function) address;
  };

  template <auto function>
  const decltype(function) Instance<function>::address = function;
} // namespace perideal

/// Compiles a function template of the dimension, which has no overloads, for 2-D and 3-D. Stands once, at
/// the end of the source file that defines it.
#define PERIDEAL_INSTANTIATE(function)                                                                       \
  template struct Instance<&function<2>>;                                                                    \
  template struct Instance<&function<3>>;

/// The same for a class template and all of its members.
#define PERIDEAL_INSTANTIATE_CLASS(name)                                                                     \
  template class name<2>;                                                                                    \
  template class name<3>;

#endif
