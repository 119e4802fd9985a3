// SPDX-License-Identifier: LGPL-2.1-or-later
// The plate of laminate_with_hole.geo in cells of 0.5 mm.
Size = 5e-4;
Include "laminate_with_hole.geo";
