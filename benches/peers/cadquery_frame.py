"""The printed parts of the frame with the v8 dimensions, in CadQuery, for the side-by-side benchmark.

    python cadquery_frame.py OUT            writes OUT/<part>.stl
    python cadquery_frame.py OUT --check    and prints volume, box and validity of each

The same solids as `flexframe build` writes, feature by feature, in exact arcs and cylinders. Some small
fillets are left out, so CadQuery has the lesser task. All lengths in mm.
"""

import math
import sys
import time
from pathlib import Path

import cadquery as cq
from cadquery import Edge, Face, Plane, Solid, Vector, Wire

SEGMENTS = 48
R2 = math.sqrt(0.5)

# --- features ----------------------------------------------------------------------------------------------

XY = Plane((0, 0, 0), (1, 0, 0), (0, 0, 1))
ALONG_X = Plane((0, 0, 0), (0, 1, 0), (1, 0, 0))  # profile (y, z), extruded along x
ALONG_Y = Plane((0, 0, 0), (1, 0, 0), (0, -1, 0))  # profile (x, z), extruded along -y


def wire(corners):
    """Closed outline of (x, y) or, with a rounded corner, (x, y, radius)."""
    ends = []
    for i, corner in enumerate(corners):
        p = Vector(*corner[:2])
        radius = corner[2] if len(corner) > 2 else 0.0
        if radius <= 0:
            ends.append((p, p, None))
            continue
        a = (Vector(*corners[i - 1][:2]) - p).normalized()
        b = (Vector(*corners[(i + 1) % len(corners)][:2]) - p).normalized()
        half = a.getAngle(b) / 2
        to_tangent, to_centre = radius / math.tan(half), radius / math.sin(half)
        middle = (a + b).normalized()
        ends.append((p + a * to_tangent, p + b * to_tangent, p + middle * (to_centre - radius)))
    edges = []
    for (start, end, top), (following, _, _) in zip(ends, ends[1:] + ends[:1]):
        if top is not None:
            edges.append(Edge.makeThreePointArc(start, top, end))
        if (following - end).Length > 1e-6:
            edges.append(Edge.makeLine(end, following))
    return Wire.assembleEdges(edges)


def circle(centre, radius):
    return Wire.makeCircle(radius, Vector(*centre), Vector(0, 0, 1))


def prism(outline, z0, z1, holes=(), plane=XY):
    outer = outline if isinstance(outline, Wire) else wire(outline)
    face = Face.makeFromWires(outer, list(holes))
    return Solid.extrudeLinear(face, Vector(0, 0, z1 - z0)).moved(cq.Location(Vector(0, 0, z0))).moved(
        plane.location
    )


def prism_x(outline, x0, x1, holes=()):
    return prism(outline, x0, x1, holes, ALONG_X)


def prism_y(outline, y0, y1, holes=()):
    return prism(outline, -y1, -y0, holes, ALONG_Y)


def cylinder(p0, p1, radius):
    p0, p1 = Vector(*p0), Vector(*p1)
    return Solid.makeCylinder(radius, (p1 - p0).Length, p0, p1 - p0)


def box(x0, x1, y0, y1, z0, z1):
    return Solid.makeBox(x1 - x0, y1 - y0, z1 - z0, Vector(x0, y0, z0))


def half_space(point, normal, size=60.0):
    plane = Plane(point, normal=normal)
    return Solid.makeBox(2 * size, 2 * size, 2 * size, Vector(-size, -size, 0)).moved(plane.location)


def revolve(outline):
    """Profile (r, z) about the z axis."""
    return Solid.revolve(
        Face.makeFromWires(wire(outline), []), 360, Vector(0, 0, 0), Vector(0, 1, 0)
    ).moved(ALONG_Y.location)


def loft(*wires):
    return Solid.makeLoft(list(wires), True)


def rectangle(x0, x1, y0, y1, radius=0.0):
    return [(x0, y0, radius), (x1, y0, radius), (x1, y1, radius), (x0, y1, radius)]


def union(first, *others):
    return first.fuse(*others) if others else first


def mirror_x(s):
    return s.mirror("YZ")


def mirror_y(s):
    return s.mirror("XZ")


def mirror_z(s):
    return s.mirror("XY")


def mirror_diagonal(s):
    """x <-> y"""
    return s.rotate(Vector(0, 0, 0), Vector(0, 0, 1), -45).mirror("XZ").rotate(
        Vector(0, 0, 0), Vector(0, 0, 1), 45
    )


def turned(s, degrees):
    return s.rotate(Vector(0, 0, 0), Vector(0, 0, 1), degrees)


# --- TPU ---------------------------------------------------------------------------------------------------

BORE, SOCKET, DEPTH, BOTTOM = 2.70, 2.90, 7.50, 5.0  # foot: bore, socket radius, depth, node to bottom
END = BOTTOM + DEPTH
PIVOT = 1.20
STRUT, LEG = Vector(-R2, -R2, 0), Vector(R2, R2, 0)
PITCH = 25.33


def at(direction, distance):
    return (direction * distance).toTuple()


def cage_socket():
    mitre = math.radians(-67.5)
    socket = cylinder((-SOCKET, 0, 0), (END, 0, 0), SOCKET)
    return socket.intersect(
        half_space((0, 0, 0), (-math.sin(mitre), math.cos(mitre), 0)),
    ).intersect(half_space(at(STRUT, PIVOT - 0.005), LEG.toTuple()))


def corner_bores(*ends):
    return [
        cylinder(at(direction, bottom), at(direction, bottom + DEPTH + 1), BORE / 2) for direction, bottom in ends
    ]


def strut_face():
    return half_space(at(STRUT, PIVOT), (STRUT - Vector(0, 0, 1)).toTuple())


def top_corner():
    cage = cage_socket()
    web = prism([(0, 0), (END, 0), (END, SOCKET), (SOCKET, END), (0, END)], -SOCKET, 0)
    body = union(cage, mirror_diagonal(cage), cylinder((0, 0, 0), at(STRUT, END), SOCKET), web)
    foot = Vector(SOCKET - PIVOT / R2, -SOCKET, 0)
    along = (Vector(SOCKET, SOCKET, 0) - foot).normalized()
    face = half_space(foot.toTuple(), (along.y, -along.x, -1))
    notch = box(-END, END, -END, END, 0, 2 * SOCKET).cut(strut_face(), face, mirror_diagonal(face))
    bores = corner_bores((Vector(1, 0, 0), BOTTOM), (Vector(0, 1, 0), BOTTOM), (STRUT, BOTTOM))
    return body.cut(notch, *bores)


def bottom_corner():
    leg_bottom, leg_pivot, lean = 11.0, 7.0, math.tan(math.radians(10))
    cage = cage_socket()
    body = union(
        cage,
        mirror_diagonal(cage),
        cylinder((0, 0, 0), at(STRUT, END), SOCKET),
        cylinder((0, 0, 0), at(LEG, leg_bottom + DEPTH), SOCKET),
    )
    leg_face = half_space(at(LEG, leg_pivot), (LEG - Vector(0, 0, lean)).toTuple())
    a1, a2 = math.radians(-67.5), math.radians(22.5)
    wedge = half_space((SOCKET - PIVOT / R2, -SOCKET, 0), (-math.sin(a1), math.cos(a1), -1)).intersect(
        half_space((leg_pivot / math.sqrt(0.5) - SOCKET, SOCKET, 0), (math.sin(a2), -math.cos(a2), -lean))
    )
    size = 2 * END
    pocket = box(-size, size, -size, size, 0, 2 * SOCKET).cut(
        strut_face(), leg_face, wedge, mirror_diagonal(wedge)
    )
    bores = corner_bores(
        (Vector(1, 0, 0), BOTTOM), (Vector(0, 1, 0), BOTTOM), (STRUT, BOTTOM), (LEG, leg_bottom)
    )
    return body.cut(pocket, *bores)


def hub_joint():
    r, y, bore, neck = 3.4, PITCH / 2, 3.2, 2.8
    inner, mouth, width = y - r, 21.38, 5.0
    bottom = mouth - 7.5
    back = bottom - 7.5
    c = (back**2 + r**2 - inner**2) / (2 * back)
    ri = math.hypot(c, inner)
    ro = ri + width
    front = c + math.sqrt(ro**2 - inner**2)
    arm = cylinder((-9, y, 0), (9.5, y, 0), r)
    ring = prism(circle((c, 0), ro), -r, r, [circle((c, 0), ri)])
    arch = ring.intersect(box(0, 2 * ro, -inner, inner, -r - 1, r + 1))
    cheek = box(0, front, inner - 0.02, y, -r, r)
    root = box(back, c + ro + 1, -r, r, -r, r).intersect(prism(circle((c, 0), ro), -r - 1, r + 1))
    leg = cylinder(((back + bottom) / 2, 0, 0), (mouth, 0, 0), r)
    chord, depth = (inner - r) / 2, r - neck / 2
    rs = (chord**2 + depth**2) / (2 * depth)
    yc, zc = (inner + r) / 2, neck / 2 + rs
    scallops = [
        cylinder((-1, sy * yc, sz * zc), (c + ro + 1, sy * yc, sz * zc), rs) for sy in (1, -1) for sz in (1, -1)
    ]
    bores = [cylinder((0, s * y, 0), (10.5, s * y, 0), bore / 2) for s in (1, -1)]
    bores.append(cylinder((bottom, 0, 0), (mouth + 1, 0, 0), bore / 2))
    return union(arm, mirror_y(arm), arch, cheek, mirror_y(cheek), root, leg).cut(*scallops, *bores)


def fork():
    r, y, gap = SOCKET, PITCH / 2, 6.13 / 2
    bottom, bar, xb, height, rounding = -12.506, 3.20, 0.30, 5.60, 1.0
    mouth, front, rear = bottom - DEPTH, xb + bar / 2, xb - bar / 2
    slope = math.radians(25)
    x0 = front + math.tan(slope) * gap - r / math.cos(slope)
    elbow = (x0 - math.tan(slope) * y, y, 0)
    finger = prism_y(
        rectangle(rear - 4.5, x0 - math.tan(slope) * gap + r / 2, -height / 2, height / 2, rounding), gap, gap + 2
    )
    side = union(
        cylinder((mouth, y, 0), elbow, r),
        cylinder(elbow, (x0, 0, 0), r),
        Solid.makeSphere(r, Vector(*elbow), Vector(0, 0, 1), -90, 90, 360),
        finger,
    ).intersect(box(mouth - 1, front + r, gap, 2 * y, -r - 1, r + 1))
    sunk = 0.6
    cross = prism_y(rectangle(rear, front, -height / 2, height / 2, rounding), -gap - sunk, gap + sunk)
    cross = cross.intersect(half_space((front, gap, 0), (-1, -1, 0))).intersect(
        half_space((front, -gap, 0), (-1, 1, 0))
    )
    body = union(side, mirror_y(side), cross).intersect(box(-60, 60, -60, 60, -height / 2, height / 2))
    return body.cut(*[cylinder((bottom, s * y, 0), (mouth - 1, s * y, 0), BORE / 2) for s in (1, -1)])


def knee():
    w, off, tilt, depth = 3.05, 2.83, math.radians(25), 7.53
    u, v = Vector(math.sin(tilt), 0, math.cos(tilt)), Vector(math.cos(tilt), 0, -math.sin(tilt))
    xc, hx, hz = 2.776 + 0.30, 1.65, 2.90
    wb, wf, flare = xc - hx, xc + hx, 1.0
    face, front, pw, edge, end = wf + flare, wf + 3.68, 6.0, 2.0, BOTTOM + depth
    rib_r = 3.2
    puck = revolve([(0, -w), (rib_r, -w, edge), (rib_r, w, edge), (0, w)]).rotate(
        Vector(0, 0, 0), Vector(1, 0, 0), 90
    )
    rib = union(
        puck.moved(cq.Location(Vector(wb, 0, hz))),
        puck.moved(cq.Location(Vector(wb, 0, -hz))),
        prism(rectangle(wb - rib_r, wb + rib_r, -w, w, edge), -hz, hz),
    )
    tube_plane = Plane((0, 0, 0), (0, 1, 0), u.toTuple())
    sign = 1 if tube_plane.yDir.dot(v) > 0 else -1
    tube = prism(
        [(w, sign * 40), (-w, sign * 40), (-w, -sign * off, edge), (w, -sign * off, edge)], -5, end, (), tube_plane
    ).intersect(box(-60, front, -60, 60, hz, 60))
    core = box(wb, front, -w, w, -hz - 0.5, hz + 0.5)
    fillet = min((pw - w) * 0.9, edge)
    tee = prism(
        [
            (front + 1, -pw),
            (face, -pw),
            (face, -w, fillet),
            (face - 20, -w),
            (face - 20, w),
            (face, w, fillet),
            (face, pw),
            (front + 1, pw),
        ],
        -60,
        60,
    )

    def mouth_z(x):
        return (end - u.x * x) / u.z

    z1, z2 = mouth_z(face - fillet), mouth_z(front)
    silhouette = prism_y([(face - fillet, -z1), (front, -z2), (front, z2), (face - fillet, z1)], -pw, pw)
    top = mouth_z(face)
    plate = silhouette.intersect(tee).intersect(prism_x(rectangle(-pw, pw, -top, top, 3.0), -60, 60))
    body = union(rib, tube, mirror_z(tube), core, plate)

    def rim(y, grow):
        outline = rectangle(wb - grow, wf + grow, -hz - grow, hz + grow, 1.0 + grow)
        return wire(outline).moved(ALONG_Y.location).moved(cq.Location(Vector(0, y, 0)))

    window = prism_y(rectangle(wb, wf, -hz, hz, 1.0), -pw - 1, pw + 1)
    steps = [(w - flare, 0.0), (w - 0.45, 0.16), (w, 0.6), (pw + 1, 1.0)]
    flares = [loft(rim(a, ga), rim(b, gb)) for (a, ga), (b, gb) in zip(steps, steps[1:])]
    bore = cylinder(at(u, BOTTOM), at(u, end + 10), BORE / 2)
    return body.cut(window, *flares, *[mirror_y(f) for f in flares], bore, mirror_z(bore))


def motor_mount():
    r, y, ring_r, w, fillet, skirt, edge = 7.5, PITCH / 2, 3.3, 3.13, 3.0, 0.8, 1.5
    top, under = ring_r, ring_r - 2.5
    bottom, low = under - 3.0, -ring_r - 1
    h = 3.0

    def waist(radius, half_width, f):
        return half_width + f, math.sqrt((radius + f) ** 2 - (half_width + f) ** 2)

    def between(radius, half_width, f, z0, z1):
        cx, cy = waist(radius, half_width, f)
        k = radius / (radius + f) * 1.001
        return prism([(-cx * k, cy * k), (-cx, cy), (cx, cy), (cx * k, cy * k), (0, 0)][::-1], z0, z1), cx, cy

    disc = revolve([(0, low), (r, low), (r, top, edge), (0, top)])
    arms = prism_y([(-w, low), (w, low), (w, top, edge), (-w, top, edge)], -y, y)
    quad, cx, cy = between(r, h, fillet, low, top)
    flare = revolve(
        [(0, low - 1), (fillet, low - 1), (fillet, top - edge), (fillet + 0.44, top - 0.44), (fillet + edge, top),
         (fillet + edge, top + 1), (0, top + 1)]
    )
    flares = [flare.moved(cq.Location(Vector(sx * cx, sy * cy, 0))) for sx in (1, -1) for sy in (1, -1)]
    outer = union(disc, union(arms, quad, mirror_y(quad)).cut(*flares)).intersect(
        box(-r - 1, r + 1, -y, y, bottom, top)
    )
    ri, hi, fi = r - skirt, h - skirt, fillet + skirt
    quad, cx, cy = between(ri, hi, fi, bottom - 1, under)
    corners = [cylinder((sx * cx, sy * cy, bottom - 2), (sx * cx, sy * cy, top), fi) for sx in (1, -1) for sy in (1, -1)]
    cavity = union(
        cylinder((0, 0, bottom - 1), (0, 0, under), ri),
        union(box(-hi, hi, -cy, cy, bottom - 1, under), quad, mirror_y(quad)).cut(*corners),
    )
    ring = cylinder((-w, y, 0), (w, y, 0), ring_r)
    holes = [cylinder((0, 0, under - 1), (0, 0, top + 1), 2.05)]
    for k in range(4):
        a = math.radians(45 + 90 * k)
        p = (4.5 * math.cos(a), 4.5 * math.sin(a))
        holes.append(cylinder((*p, under - 1), (*p, top + 1), 1.0))
    holes += [cylinder((-r - 2, s * y, 0), (r + 2, s * y, 0), 1.6) for s in (1, -1)]
    return union(outer.cut(cavity), ring, mirror_y(ring)).cut(*holes)


# --- rigid -------------------------------------------------------------------------------------------------

HALF = 4.6  # half height of the hub
FLANK = PITCH / 2 + 3.4 + 1.904
TIE = FLANK * math.sqrt(2)
TIE_RING = 3.5
TIES = [(TIE, 0), (0, TIE), (-TIE, 0), (0, -TIE)]


def hub():
    plate_top, mouth, edge, side, pitch = -HALF + 4.0, 27.664, 2.0, 17.264, PITCH / 2
    inner = pitch - math.sqrt(HALF**2 - plate_top**2)
    # one boss of a pair, profile (t, z): round inside, flat outside, swept along the diagonal s
    boss_round = cylinder((inner, pitch, 0), (mouth, pitch, 0), HALF)
    boss_flat = prism_x([(pitch, -HALF), (FLANK, -HALF, edge), (FLANK, HALF, edge), (pitch, HALF)], inner, mouth)
    boss_foot = prism_x([(inner, -HALF, edge), (pitch, -HALF), (pitch, plate_top), (inner, plate_top)], inner, mouth)
    web = prism_x([(inner - 2, plate_top - 0.4), (inner, plate_top, 3.0), (inner + 1, 1.2), (pitch, plate_top - 0.4)],
                  inner, side)
    one = union(boss_round, boss_flat, boss_foot, web)
    pair = union(one, mirror_y(one))
    arms = union(*[turned(pair, 45 + 90 * k) for k in range(4)])
    xt, big = TIE - 5.74, 3 * FLANK
    dish = [(-xt, HALF + 1), (-xt, HALF - 1), (-xt + 3, plate_top, 3.0), (xt - 3, plate_top, 3.0), (xt, HALF - 1),
            (xt, HALF + 1)]
    arms = arms.cut(prism_y(dish, -big, big).intersect(prism_x(dish, -big, big)))
    slab = [(-side, -HALF, edge), (side, -HALF, edge), (side, plate_top), (-side, plate_top)]
    plate = turned(prism_y(slab, -side - 5, side + 5).intersect(prism_x(slab, -side - 5, side + 5)), 45)
    ear = revolve([(0, -HALF), (TIE_RING, -HALF, edge), (TIE_RING, HALF, edge), (0, HALF)])
    ears = [ear.moved(cq.Location(Vector(x, y, 0))) for x, y in TIES]
    bore = cylinder((mouth - 9.0, pitch, 0), (mouth + 1, pitch, 0), 3.4)
    cuts = [turned(b, 45 + 90 * k) for k in range(4) for b in (bore, mirror_y(bore))]
    cuts += [cylinder((x, y, -HALF - 1), (x, y, HALF + 1), 1.5) for x, y in TIES]
    for x, y in [(10, 10), (-10, 10), (-10, -10), (10, -10)]:
        cuts.append(cylinder((x, y, -HALF - 1), (x, y, plate_top + 1), 0.95))
        cuts.append(cylinder((x, y, plate_top - 1.9), (x, y, 2 * HALF), 2.1))
    return union(arms, plate, *ears).cut(*cuts)


def bar(p, q, width, z0, z1):
    p, q = Vector(*p), Vector(*q)
    n = Vector(-(q - p).y, (q - p).x, 0).normalized() * (width / 2)
    return prism([(p - n).toTuple()[:2], (q - n).toTuple()[:2], (q + n).toTuple()[:2], (p + n).toTuple()[:2]], z0, z1)


def pi_carrier():
    z = 2.0
    pads = [(x, y) for x in (11.5, -11.5) for y in (29.0, -29.0)]
    solids = [cylinder((*p, 0), (*p, z), TIE_RING) for p in TIES]
    solids += [cylinder((*p, 0), (*p, z), 2.5) for p in pads]
    solids += [bar(TIES[k - 1], TIES[k], 4.0, 0, z) for k in range(4)]
    for x, y in pads:
        solids.append(bar((0, math.copysign(TIE, y)), (x, y), 3.0, 0, z))
        solids.append(bar((x, y), (x, math.copysign(TIE - 11.5, y)), 3.0, 0, z))
    holes = [cylinder((*p, -1), (*p, z + 1), 2.0) for p in TIES]
    holes += [cylinder((*p, -1), (*p, z + 1), 1.375) for p in pads]
    return union(*solids).cut(*holes)


BRACKET_H, BRACKET_L, BRACKET_W = 21.5, TIE + TIE_RING, 13.21 / 2
CONNECTOR_Z, MAGNET_Z = -17.875, -10.6


def connector(inset, cz):
    w, h, c = 10.55 / 2 - inset, 5.55 / 2 - inset, 1.5 - inset / 2
    return [(-w + c, cz - h), (w, cz - h, 0.65), (w, cz + h, 0.65), (-w + c, cz + h), (-w, cz + h - c),
            (-w, cz - h + c)]


def battery_bracket():
    h, l, w, base = BRACKET_H, BRACKET_L, BRACKET_W, 3.0
    inside = l - 2 * TIE_RING
    body = prism_x(
        [(-l, -h), (l, -h), (l, 0), (inside, 0), (inside, -h + base), (-inside, -h + base, 2.5), (-inside, 0), (-l, 0)],
        -w, w,
    )
    cuts = [
        prism_y(connector(0, CONNECTOR_Z), -l - 1, inside),
        box(-10.55 / 2, 10.55 / 2, -inside, inside, CONNECTOR_Z, -h + base + 2.51),
        box(-5.1, 5.1, -l - 1, -l + 3.0, MAGNET_Z - 2.6, MAGNET_Z + 2.6),
    ]
    for s in (1, -1):
        cuts.append(cylinder((s * 2.5, -l - 1, MAGNET_Z), (s * 2.5, -inside + 1, MAGNET_Z), 1.5))
        for k in range(3):
            z = MAGNET_Z - 4.25 * k
            cuts.append(cylinder((s * 2.5, inside - 1, z), (s * 2.5, l + 1, z), 1.5))
        cuts.append(cylinder((0, s * TIE, -6), (0, s * TIE, 1), 2.0))
        y0, y1 = sorted((s * TIE, s * (l + 1)))
        cuts.append(box(-1.75, 1.75, y0, y1, -6, -4))
    return body.cut(*cuts)


IW, IH, OW, OH = 16.0, 8.1, 17.0, 9.5
SLEEVE_L = 45.0


def battery_sleeve():
    length, channel, hp, yh = SLEEVE_L, 13.21 / 2 + 0.1, 15.25, SLEEVE_L + 10.75
    tube = prism_y(rectangle(-OW, OW, -OH, OH, 1.0), 0, length)
    rib = prism_y([(channel, OH - 0.4), (channel + 2.4, OH - 0.4), (channel + 2.4, OH), (channel + 2.4, OH + 1.5, 1.5),
                   (channel, OH + 1.5)], 0, length)
    lug = [(OW - 0.4, -6.5), (OW, -6.5), (OW + 1.5, -5.5), (OW + 1.5, 4.5), (OW, 5.5), (OW - 0.4, 5.5)]
    lugs = [prism_y(lug, yc - 2.5, yc + 2.5) for yc in (10.0, length - 10.0)]
    z1 = OH + 1.0
    z0, yf, y0 = z1 - 2.0, yh + 2.0, length - 3.1
    outline = [(-OW, y0), (OW, y0), (OW, length + 3.04), (hp + 2.75, yh), (hp, yh), (hp - 2.5, yf), (-hp + 2.5, yf),
               (-hp, yh), (-hp - 2.75, yh), (-OW, length + 3.04)]
    tray = union(prism(outline, z0, z1), *[cylinder((s * hp, yh, z0), (s * hp, yh, z1), 2.75) for s in (1, -1)])
    window = OW - 7.4
    tray = tray.cut(
        box(-channel - 0.3, channel + 0.3, y0 - 1, length, z0 - 1, z1 + 1),
        prism([(-window, length, 2.9), (window, length, 2.9), (window, yf - 4, 1.25), (-window, yf - 4, 1.25)],
              z0 - 1, z1 + 1),
    )
    wedge = prism_x([(y0 + 0.1, OH - 0.3), (y0 + 0.1, z1 - 0.02), (y0 - 1.6, OH - 0.02), (y0 - 1.6, OH - 0.3)],
                    channel + 0.3, OW - 1)
    lead = loft(
        *[wire(rectangle(-IW - d, IW + d, -IH - d, IH + d)).moved(ALONG_Y.location).moved(cq.Location(Vector(0, y, 0)))
          for d, y in ((0.75, -0.1), (-0.1, 0.75))]
    )
    body = union(tube, tray, rib, mirror_x(rib), wedge, mirror_x(wedge), *lugs, *[mirror_x(l) for l in lugs])
    return body.cut(
        box(-IW, IW, -1, length + 20, -IH, IH),
        lead,
        *[cylinder((s * hp, yh, z0 - 1), (s * hp, yh, z1 + 1), 1.5) for s in (1, -1)],
    )


def battery_lid():
    deck_z, y1, cover = OH - 0.1, -13.112, 13.002
    y2 = y1 - 7.38
    cz, mz = CONNECTOR_Z + BRACKET_H + OH, MAGNET_Z + BRACKET_H + OH
    step = 0.75
    zc = cz + 5.55 / 2 - step + 1.35
    ya = -cover - 4.5
    deck = prism_x([(y2, IH), (0, IH), (0, deck_z, 0.6), (y1, deck_z), (y1, zc), (y2, zc, 1.0)], -OW, OW)
    wall = [(0, -OH), (0, deck_z - 0.6), (-0.5, deck_z + 0.3), (y1 - 0.02, zc - 0.2), (y2 + 1, zc - 0.2),
            (y2 + 1, IH + 0.3), (ya, IH + 0.3), (ya, IH), (-cover, IH, 4.5), (-cover, -OH)]
    walls = [prism_x(wall, IW, OW), prism_x(wall, -OW, -IW)]
    cheek = [(0, IH + 0.3), (0, deck_z - 0.6), (-0.5, deck_z + 0.3), (y1 - 0.02, zc - 0.2), (y2 + 3, zc - 0.2),
             (y2 + 3, IH + 0.3)]
    walls += [prism_x(cheek, OW - 1.5, OW), prism_x(cheek, -OW, -OW + 1.5)]
    floor = box(-OW, OW, -cover, 0, -OH, -IH)
    body = union(deck, floor, *walls)
    body = body.intersect(prism_y(rectangle(-OW, OW, -OH, zc, 1.0), y2 - 1, 1))
    body = body.intersect(prism([(-OW, 1), (-OW, y2, 5.5), (OW, y2, 5.5), (OW, 1)], -OH - 1, zc + 1))
    w, r, depth = BRACKET_W, 2.0, 3.0 + 0.29 - 0.2
    top, back = mz + 2.6 + 1.5, y1 - depth - 1.71
    tower = prism_y([(-w, zc - 1.5), (w, zc - 1.5), (w, top, r), (-w, top, r)], back, y1)
    tower = tower.intersect(prism([(-w, y1), (-w, back, r), (w, back, r), (w, y1)], zc - 2, top + 1))
    tower = tower.intersect(prism_x([(back, zc - 2), (y1, zc - 2), (y1, top), (back, top, r)], -w - 1, w + 1))
    f = max(back - (y2 + 1.0), 0.4)
    foot = prism_x([(back + 0.3, zc - 0.3), (back + 0.3, zc + f), (back, zc + f), (back, zc, 0.9 * f), (back - f, zc),
                    (back - f, zc - 0.3)], -w + r, w - r)
    return union(body, tower, foot).cut(
        prism_y(connector(step, cz), y2 - 1, y1 + 1), box(-5.1, 5.1, y1 - depth, y1 + 1, mz - 2.6, mz + 2.6)
    )


def camera_connector_left():
    off, foot_h, reach, up, zc, hole = -1.0, 4.3, 19.55, 6.25, 8.173, 1.0
    back, rear = reach - 3.5, reach - 1.5
    inner, outer, block_x = off - 2.0, off + 2.0, 3.0
    z0, z1 = zc - 3.673, zc + 0.327
    yb = 13.55
    foot = union(cylinder((0, 0, 0), (0, 0, foot_h), 2.0), box(-2, 2, 0, 4, 0, foot_h))
    arm = loft(
        *[wire(rectangle(x0, x1, za, zb)).moved(ALONG_Y.location).moved(cq.Location(Vector(0, y, 0)))
          for x0, x1, za, zb, y in ((-2, 2, 0, foot_h, 3.99), (inner, block_x, z0, z1, yb + 0.01))]
    )
    block = prism([(inner, yb - 0.01), (block_x, yb - 0.01), (block_x, rear, 1.5), (inner, rear)], z0, z1)
    upright = prism_y(
        [(inner, zc - up), (outer, zc - up), (outer, z0, 1.0), (block_x, z0), (block_x, z1), (outer, z1, 1.0),
         (outer, zc + up), (inner, zc + up)], back, rear,
    ).intersect(prism([(inner - 1, yb - 1), (block_x, yb - 1), (block_x, rear, 1.5), (inner - 1, rear)],
                      zc - up - 1, zc + up + 1))
    posts = [cylinder((off, back, zc + s * up), (off, reach, zc + s * up), hole + 1.2) for s in (1, -1)]
    cuts = [cylinder((0, 0, -1), (0, 0, foot_h + 1), hole), box(inner - 5, inner, back - 1, reach + 1, zc - up - 9,
                                                                zc + up + 9)]
    cuts += [cylinder((off, back - 1, zc + s * up), (off, reach + 1, zc + s * up), hole) for s in (1, -1)]
    return union(foot, arm, block, upright, *posts).cut(*cuts)


def camera_connector_right():
    return mirror_x(camera_connector_left())


PARTS = [
    top_corner, bottom_corner, knee, fork, motor_mount, hub_joint, hub, pi_carrier, battery_bracket, battery_sleeve,
    battery_lid, camera_connector_left, camera_connector_right,
]  # fmt: skip


def main():
    arguments = [a for a in sys.argv[1:] if a != "--check"]
    out = Path(arguments[0] if arguments else "out")
    out.mkdir(parents=True, exist_ok=True)
    for part in PARTS:
        start = time.perf_counter()
        solid = part()
        solid.exportStl(str(out / f"{part.__name__}.stl"), tolerance=0.05, angularTolerance=2 * math.pi / SEGMENTS)
        line = f"{part.__name__:24} {time.perf_counter() - start:6.2f} s"
        if "--check" in sys.argv:
            b = solid.BoundingBox()
            size = f"{b.xlen:.2f} x {b.ylen:.2f} x {b.zlen:.2f} mm"
            line += f"  {solid.Volume():9.1f} mm3  {size:28}  {len(solid.Solids())} solid, valid: {solid.isValid()}"
        print(line)


if __name__ == "__main__":
    main()
