// SPDX-License-Identifier: LGPL-2.1-or-later
// The plate of plate_unstructured.geo in about 9,000 quadrilaterals.
Mesh.CharacteristicLengthFactor = 0.485;
Include "plate_unstructured.geo";
