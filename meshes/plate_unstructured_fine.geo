// SPDX-License-Identifier: LGPL-2.1-or-later
// The plate of plate_unstructured.geo in about 8,700 quadrilaterals.
Mesh.CharacteristicLengthFactor = 0.493;
Include "plate_unstructured.geo";
