// The printed parts of the frame with the v8 dimensions, in OpenSCAD, for the side-by-side benchmark.
//
//     openscad -o hub.stl -D 'part="hub"' openscad_frame.scad
//
// The same solids as `flexframe build` writes, feature by feature, with the same 48 segments a circle and
// bores drawn around the circle. Some small fillets are left out, so OpenSCAD has the lesser task. mm.

part = "hub";

$fn = 48;
R2 = sqrt(0.5);
FAR = 60;

// --- features ---------------------------------------------------------------------------------------------

function unit(v) = v / norm(v);
function at2(p) = [p[0], p[1]];

// Points of a rounded corner p with radius r between its neighbours a and b.
function corner(a, p, b, r) =
    let (u = unit(a - p), v = unit(b - p), half = acos(max(-1, min(1, u * v))) / 2,
         c = p + unit(u + v) * r / sin(half), s = p + u * r / tan(half) - c, e = p + v * r / tan(half) - c,
         a0 = atan2(s[1], s[0]), d0 = atan2(e[1], e[0]) - a0, d = d0 > 180 ? d0 - 360 : d0 < -180 ? d0 + 360 : d0,
         n = max(2, ceil(abs(d) / 360 * $fn)))
    [for (i = [0:n]) c + r * [cos(a0 + d * i / n), sin(a0 + d * i / n)]];

// Closed outline of [x, y] or, with a rounded corner, [x, y, radius].
function outline(v) =
    [for (i = [0:len(v) - 1])
        let (p = v[i], r = len(p) > 2 ? p[2] : 0, a = v[(i + len(v) - 1) % len(v)], b = v[(i + 1) % len(v)])
        each r > 0 ? corner(at2(a), at2(p), at2(b), r) : [at2(p)]];

function rectangle(x0, x1, y0, y1, r = 0) = [[x0, y0, r], [x1, y0, r], [x1, y1, r], [x0, y1, r]];

module prism(v, z0, z1) translate([0, 0, z0]) linear_extrude(z1 - z0) polygon(outline(v));
// profile (y, z), extruded along x; profile (x, z), extruded along y
module along_x() multmatrix([[0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0]]) children();
module along_y() multmatrix([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0]]) children();
module prism_x(v, x0, x1) along_x() prism(v, x0, x1);
module prism_y(v, y0, y1) along_y() prism(v, -y1, -y0);
module box(x0, x1, y0, y1, z0, z1) translate([x0, y0, z0]) cube([x1 - x0, y1 - y0, z1 - z0]);

// Local z turned to d.
module towards(d, p = [0, 0, 0])
    translate(p) rotate([0, acos(d[2] / norm(d)), atan2(d[1], d[0])]) children();

module rod(p0, p1, r) towards(p1 - p0, p0) cylinder(r = r, h = norm(p1 - p0));
module bore(p0, p1, r) rod(p0, p1, r / cos(180 / $fn));
module half_space(p, n) towards(n, p) translate([-FAR, -FAR, 0]) cube(2 * FAR);
// Profile (r, z) about z.
module turned_profile(v) rotate_extrude() polygon(outline(v));

module both_x() { children(); mirror([1, 0, 0]) children(); }
module both_y() { children(); mirror([0, 1, 0]) children(); }
module both_z() { children(); mirror([0, 0, 1]) children(); }
module both_diagonal() { children(); mirror([1, -1, 0]) children(); }

// --- TPU --------------------------------------------------------------------------------------------------

BORE = 2.70; SOCKET = 2.90; DEPTH = 7.50; BOTTOM = 5.0; END = BOTTOM + DEPTH; PIVOT = 1.20; PITCH = 25.33;
STRUT = [-R2, -R2, 0]; LEG = [R2, R2, 0];

module cage_socket() intersection() {
    rod([-SOCKET, 0, 0], [END, 0, 0], SOCKET);
    half_space([0, 0, 0], [-sin(-67.5), cos(-67.5), 0]);
    half_space(STRUT * (PIVOT - 0.005), LEG);
}
module strut_face() half_space(STRUT * PIVOT, STRUT - [0, 0, 1]);
module socket_bore(d, bottom) bore(d * bottom, d * (bottom + DEPTH + 1), BORE / 2);

module top_corner() {
    foot = [SOCKET - PIVOT / R2, -SOCKET, 0];
    along = unit([SOCKET, SOCKET, 0] - foot);
    difference() {
        union() {
            both_diagonal() cage_socket();
            rod([0, 0, 0], STRUT * END, SOCKET);
            prism([[0, 0], [END, 0], [END, SOCKET], [SOCKET, END], [0, END]], -SOCKET, 0);
        }
        difference() {
            box(-END, END, -END, END, 0, 2 * SOCKET);
            strut_face();
            both_diagonal() half_space(foot, [along[1], -along[0], -1]);
        }
        both_diagonal() socket_bore([1, 0, 0], BOTTOM);
        socket_bore(STRUT, BOTTOM);
    }
}

module bottom_corner() {
    leg_bottom = 11.0; leg_pivot = 7.0; lean = tan(10); size = 2 * END;
    difference() {
        union() {
            both_diagonal() cage_socket();
            rod([0, 0, 0], STRUT * END, SOCKET);
            rod([0, 0, 0], LEG * (leg_bottom + DEPTH), SOCKET);
        }
        difference() {
            box(-size, size, -size, size, 0, 2 * SOCKET);
            strut_face();
            half_space(LEG * leg_pivot, LEG - [0, 0, lean]);
            both_diagonal() intersection() {
                half_space([SOCKET - PIVOT / R2, -SOCKET, 0], [-sin(-67.5), cos(-67.5), -1]);
                half_space([leg_pivot / R2 - SOCKET, SOCKET, 0], [sin(22.5), -cos(22.5), -lean]);
            }
        }
        both_diagonal() socket_bore([1, 0, 0], BOTTOM);
        socket_bore(STRUT, BOTTOM);
        socket_bore(LEG, leg_bottom);
    }
}

module hub_joint() {
    r = 3.4; y = PITCH / 2; neck = 2.8; inner = y - r; mouth = 21.38; bottom = mouth - 7.5; back = bottom - 7.5;
    c = (back * back + r * r - inner * inner) / (2 * back);
    ri = norm([c, inner]); ro = ri + 5.0; front = c + sqrt(ro * ro - inner * inner);
    chord = (inner - r) / 2; depth = r - neck / 2; rs = (chord * chord + depth * depth) / (2 * depth);
    difference() {
        union() {
            both_y() rod([-9, y, 0], [9.5, y, 0], r);
            intersection() {
                translate([c, 0, -r]) difference() {
                    cylinder(r = ro, h = 2 * r, $fn = 4 * 48);
                    translate([0, 0, -1]) cylinder(r = ri, h = 2 * r + 2, $fn = 4 * 48);
                }
                box(0, 2 * ro, -inner, inner, -r - 1, r + 1);
            }
            both_y() box(0, front, inner - 0.02, y, -r, r);
            intersection() {
                box(back, c + ro + 1, -r, r, -r, r);
                translate([c, 0, -r - 1]) cylinder(r = ro, h = 2 * r + 2, $fn = 4 * 48);
            }
            rod([(back + bottom) / 2, 0, 0], [mouth, 0, 0], r);
        }
        both_y() both_z() rod([-1, (inner + r) / 2, neck / 2 + rs], [c + ro + 1, (inner + r) / 2, neck / 2 + rs], rs);
        both_y() bore([0, y, 0], [10.5, y, 0], 1.6);
        bore([bottom, 0, 0], [mouth + 1, 0, 0], 1.6);
    }
}

module fork() {
    r = SOCKET; y = PITCH / 2; gap = 6.13 / 2; bottom = -12.506; bar = 3.20; xb = 0.30; height = 5.60;
    mouth = bottom - DEPTH; front = xb + bar / 2; rear = xb - bar / 2; slope = 25; sunk = 0.6;
    x0 = front + tan(slope) * gap - r / cos(slope);
    elbow = [x0 - tan(slope) * y, y, 0];
    difference() {
        intersection() {
            union() {
                both_y() intersection() {
                    union() {
                        rod([mouth, y, 0], elbow, r);
                        rod(elbow, [x0, 0, 0], r);
                        translate(elbow) sphere(r);
                        prism_y(rectangle(rear - 4.5, x0 - tan(slope) * gap + r / 2, -height / 2, height / 2, 1),
                                gap, gap + 2);
                    }
                    box(mouth - 1, front + r, gap, 2 * y, -r - 1, r + 1);
                }
                intersection() {
                    prism_y(rectangle(rear, front, -height / 2, height / 2, 1), -gap - sunk, gap + sunk);
                    half_space([front, gap, 0], [-1, -1, 0]);
                    half_space([front, -gap, 0], [-1, 1, 0]);
                }
            }
            box(-FAR, FAR, -FAR, FAR, -height / 2, height / 2);
        }
        both_y() bore([bottom, y, 0], [mouth - 1, y, 0], BORE / 2);
    }
}

module knee() {
    w = 3.05; off = 2.83; tilt = 25; depth = 7.53; u = [sin(tilt), 0, cos(tilt)];
    xc = 2.776 + 0.30; hx = 1.65; hz = 2.90; wb = xc - hx; wf = xc + hx; flare = 1;
    face = wf + flare; front = wf + 3.68; pw = 6; edge = 2; end = BOTTOM + depth; rib = 3.2;
    fillet = min((pw - w) * 0.9, edge);
    z1 = (end - u[0] * (face - fillet)) / u[2]; z2 = (end - u[0] * front) / u[2]; top = (end - u[0] * face) / u[2];
    steps = [[w - flare, 0], [w - 0.45, 0.16], [w, 0.6], [pw + 1, 1]];
    module rim(y, grow)
        prism_y(rectangle(wb - grow, wf + grow, -hz - grow, hz + grow, 1 + grow), y - 0.0001, y + 0.0001);
    difference() {
        union() {
            hull() both_z() translate([wb, 0, hz]) rotate([90, 0, 0])
                turned_profile([[0, -w], [rib, -w, edge], [rib, w, edge], [0, w]]);
            both_z() intersection() {
                // cross-section of the tube: x to the front, across the strut
                multmatrix([[cos(tilt), 0, u[0], 0], [0, 1, 0, 0], [-sin(tilt), 0, u[2], 0]])
                    prism([[40, -w], [40, w], [-off, w, edge], [-off, -w, edge]], -5, end);
                box(-FAR, front, -FAR, FAR, hz, FAR);
            }
            box(wb, front, -w, w, -hz - 0.5, hz + 0.5);
            intersection() {
                prism_y([[face - fillet, -z1], [front, -z2], [front, z2], [face - fillet, z1]], -pw, pw);
                prism([[front + 1, -pw], [face, -pw], [face, -w, fillet], [face - 20, -w],
                       [face - 20, w], [face, w, fillet], [face, pw], [front + 1, pw]], -FAR, FAR);
                prism_x(rectangle(-pw, pw, -top, top, 3), -FAR, FAR);
            }
        }
        prism_y(rectangle(wb, wf, -hz, hz, 1), -pw - 1, pw + 1);
        both_y() for (i = [0:2]) hull() {
            rim(steps[i][0], steps[i][1]);
            rim(steps[i + 1][0], steps[i + 1][1]);
        }
        both_z() bore(u * BOTTOM, u * (end + 10), BORE / 2);
    }
}

module motor_mount() {
    r = 7.5; y = PITCH / 2; ring = 3.3; w = 3.13; fillet = 3; skirt = 0.8; edge = 1.5; h = 3;
    top = ring; under = ring - 2.5; bottom = under - 3; low = -ring - 1;
    function waist(radius, half, f) = [half + f, sqrt(pow(radius + f, 2) - pow(half + f, 2))];
    module between(radius, half, f, z0, z1) {
        c = waist(radius, half, f); t = c * radius / (radius + f) * 1.001;
        prism([[0, 0], t, c, [-c[0], c[1]], [-t[0], t[1]]], z0, z1);
    }
    c = waist(r, h, fillet); ci = waist(r - skirt, h - skirt, fillet + skirt);
    difference() {
        union() {
            difference() {
                intersection() {
                    union() {
                        turned_profile([[0, low], [r, low], [r, top, edge], [0, top]]);
                        difference() {
                            union() {
                                prism_y([[-w, low], [w, low], [w, top, edge], [-w, top, edge]], -y, y);
                                both_y() between(r, h, fillet, low, top);
                            }
                            both_x() both_y() translate(c) turned_profile(
                                [[0, low - 1], [fillet, low - 1], [fillet, top - edge], [fillet + 0.44, top - 0.44],
                                 [fillet + edge, top], [fillet + edge, top + 1], [0, top + 1]]);
                        }
                    }
                    box(-r - 1, r + 1, -y, y, bottom, top);
                }
                translate([0, 0, bottom - 1]) cylinder(r = r - skirt, h = under - bottom + 1);
                difference() {
                    union() {
                        box(-h + skirt, h - skirt, -ci[1], ci[1], bottom - 1, under);
                        both_y() between(r - skirt, h - skirt, fillet + skirt, bottom - 1, under);
                    }
                    both_x() both_y() translate([ci[0], ci[1], bottom - 2])
                        cylinder(r = fillet + skirt, h = top - bottom + 2);
                }
            }
            both_y() rod([-w, y, 0], [w, y, 0], ring);
        }
        bore([0, 0, under - 1], [0, 0, top + 1], 2.05);
        for (k = [0:3]) rotate(45 + 90 * k) bore([4.5, 0, under - 1], [4.5, 0, top + 1], 1);
        both_y() bore([-r - 2, y, 0], [r + 2, y, 0], 1.6);
    }
}

// --- rigid ------------------------------------------------------------------------------------------------

HALF = 4.6; FLANK = PITCH / 2 + 3.4 + 1.904; TIE = FLANK * sqrt(2); TIE_RING = 3.5;
module at_ties() for (k = [0:3]) rotate(90 * k) translate([TIE, 0, 0]) children();

module hub() {
    top = -HALF + 4; mouth = 27.664; edge = 2; side = 17.264; pitch = PITCH / 2;
    inner = pitch - sqrt(HALF * HALF - top * top); xt = TIE - 5.74; big = 3 * FLANK;
    dish = [[-xt, HALF + 1], [-xt, HALF - 1], [-xt + 3, top, 3], [xt - 3, top, 3], [xt, HALF - 1], [xt, HALF + 1]];
    slab = [[-side, -HALF, edge], [side, -HALF, edge], [side, top], [-side, top]];
    difference() {
        union() {
            difference() {
                for (k = [0:3]) rotate(45 + 90 * k) both_y() {
                    rod([inner, pitch, 0], [mouth, pitch, 0], HALF);
                    prism_x([[pitch, -HALF], [FLANK, -HALF, edge], [FLANK, HALF, edge], [pitch, HALF]], inner, mouth);
                    prism_x([[inner, -HALF, edge], [pitch, -HALF], [pitch, top], [inner, top]], inner, mouth);
                    prism_x([[inner - 2, top - 0.4], [inner, top, 3], [inner + 1, 1.2], [pitch, top - 0.4]],
                            inner, side);
                }
                intersection() {
                    prism_y(dish, -big, big);
                    prism_x(dish, -big, big);
                }
            }
            rotate(45) intersection() {
                prism_y(slab, -side - 5, side + 5);
                prism_x(slab, -side - 5, side + 5);
            }
            at_ties() turned_profile([[0, -HALF], [TIE_RING, -HALF, edge], [TIE_RING, HALF, edge], [0, HALF]]);
        }
        for (k = [0:3]) rotate(45 + 90 * k) both_y() bore([mouth - 9, pitch, 0], [mouth + 1, pitch, 0], 3.4);
        at_ties() bore([0, 0, -HALF - 1], [0, 0, HALF + 1], 1.5);
        both_x() both_y() translate([10, 10, 0]) {
            bore([0, 0, -HALF - 1], [0, 0, top + 1], 0.95);
            bore([0, 0, top - 1.9], [0, 0, 2 * HALF], 2.1);
        }
    }
}

module bar(p, q, width, h) {
    n = unit([p[1] - q[1], q[0] - p[0]]) * width / 2;
    prism([p - n, q - n, q + n, p + n], 0, h);
}

module pi_carrier() {
    h = 2; pad = [11.5, 29];
    difference() {
        union() {
            at_ties() cylinder(r = TIE_RING, h = h);
            both_x() both_y() translate(pad) cylinder(r = 2.5, h = h);
            for (k = [0:3]) rotate(90 * k) bar([TIE, 0], [0, TIE], 4, h);
            both_x() both_y() {
                bar([0, TIE], pad, 3, h);
                bar(pad, [pad[0], TIE - pad[0]], 3, h);
            }
        }
        at_ties() bore([0, 0, -1], [0, 0, h + 1], 2);
        both_x() both_y() translate(pad) bore([0, 0, -1], [0, 0, h + 1], 1.375);
    }
}

BRACKET_H = 21.5; BRACKET_L = TIE + TIE_RING; BRACKET_W = 13.21 / 2; CONNECTOR_Z = -17.875; MAGNET_Z = -10.6;

function connector(inset, cz) =
    let (w = 10.55 / 2 - inset, h = 5.55 / 2 - inset, c = 1.5 - inset / 2)
    [[-w + c, cz - h], [w, cz - h, 0.65], [w, cz + h, 0.65], [-w + c, cz + h], [-w, cz + h - c], [-w, cz - h + c]];

module battery_bracket() {
    h = BRACKET_H; l = BRACKET_L; w = BRACKET_W; base = 3; inside = l - 2 * TIE_RING;
    difference() {
        prism_x([[-l, -h], [l, -h], [l, 0], [inside, 0], [inside, -h + base], [-inside, -h + base, 2.5],
                 [-inside, 0], [-l, 0]], -w, w);
        prism_y(connector(0, CONNECTOR_Z), -l - 1, inside);
        box(-10.55 / 2, 10.55 / 2, -inside, inside, CONNECTOR_Z, -h + base + 2.51);
        box(-5.1, 5.1, -l - 1, -l + 3, MAGNET_Z - 2.6, MAGNET_Z + 2.6);
        both_x() {
            bore([2.5, -l - 1, MAGNET_Z], [2.5, -inside + 1, MAGNET_Z], 1.5);
            for (k = [0:2]) bore([2.5, inside - 1, MAGNET_Z - 4.25 * k], [2.5, l + 1, MAGNET_Z - 4.25 * k], 1.5);
        }
        both_y() {
            bore([0, TIE, -6], [0, TIE, 1], 2);
            box(-1.75, 1.75, TIE, l + 1, -6, -4);
        }
    }
}

IW = 16; IH = 8.1; OW = 17; OH = 9.5; SLEEVE_L = 45;

module battery_sleeve() {
    len = SLEEVE_L; channel = 13.21 / 2 + 0.1; hp = 15.25; yh = len + 10.75;
    z1 = OH + 1; z0 = z1 - 2; yf = yh + 2; y0 = len - 3.1; window = OW - 7.4;
    module lead(d, y) prism_y(rectangle(-IW - d, IW + d, -IH - d, IH + d), y - 0.0001, y + 0.0001);
    difference() {
        union() {
            prism_y(rectangle(-OW, OW, -OH, OH, 1), 0, len);
            both_x() {
                prism_y([[channel, OH - 0.4], [channel + 2.4, OH - 0.4], [channel + 2.4, OH],
                         [channel + 2.4, OH + 1.5, 1.5], [channel, OH + 1.5]], 0, len);
                for (yc = [10, len - 10])
                    prism_y([[OW - 0.4, -6.5], [OW, -6.5], [OW + 1.5, -5.5], [OW + 1.5, 4.5], [OW, 5.5],
                             [OW - 0.4, 5.5]], yc - 2.5, yc + 2.5);
                prism_x([[y0 + 0.1, OH - 0.3], [y0 + 0.1, z1 - 0.02], [y0 - 1.6, OH - 0.02], [y0 - 1.6, OH - 0.3]],
                        channel + 0.3, OW - 1);
            }
            difference() {
                union() {
                    prism([[-OW, y0], [OW, y0], [OW, len + 3.04], [hp + 2.75, yh], [hp, yh], [hp - 2.5, yf],
                           [-hp + 2.5, yf], [-hp, yh], [-hp - 2.75, yh], [-OW, len + 3.04]], z0, z1);
                    both_x() rod([hp, yh, z0], [hp, yh, z1], 2.75);
                }
                box(-channel - 0.3, channel + 0.3, y0 - 1, len, z0 - 1, z1 + 1);
                prism([[-window, len, 2.9], [window, len, 2.9], [window, yf - 4, 1.25], [-window, yf - 4, 1.25]],
                      z0 - 1, z1 + 1);
            }
        }
        box(-IW, IW, -1, len + 20, -IH, IH);
        hull() { lead(0.75, -0.1); lead(-0.1, 0.75); }
        both_x() bore([hp, yh, z0 - 1], [hp, yh, z1 + 1], 1.5);
    }
}

module battery_lid() {
    deck_z = OH - 0.1; y1 = -13.112; y2 = y1 - 7.38; cover = 13.002; step = 0.75;
    cz = CONNECTOR_Z + BRACKET_H + OH; mz = MAGNET_Z + BRACKET_H + OH; zc = cz + 5.55 / 2 - step + 1.35;
    ya = -cover - 4.5; w = BRACKET_W; r = 2; depth = 3 + 0.29 - 0.2; top = mz + 2.6 + 1.5; back = y1 - depth - 1.71;
    f = max(back - (y2 + 1), 0.4);
    difference() {
        union() {
            intersection() {
                union() {
                    prism_x([[y2, IH], [0, IH], [0, deck_z, 0.6], [y1, deck_z], [y1, zc], [y2, zc, 1]], -OW, OW);
                    both_x() prism_x([[0, -OH], [0, deck_z - 0.6], [-0.5, deck_z + 0.3], [y1 - 0.02, zc - 0.2],
                                      [y2 + 1, zc - 0.2], [y2 + 1, IH + 0.3], [ya, IH + 0.3], [ya, IH],
                                      [-cover, IH, 4.5], [-cover, -OH]], IW, OW);
                    both_x() prism_x([[0, IH + 0.3], [0, deck_z - 0.6], [-0.5, deck_z + 0.3], [y1 - 0.02, zc - 0.2],
                                      [y2 + 3, zc - 0.2], [y2 + 3, IH + 0.3]], OW - 1.5, OW);
                    box(-OW, OW, -cover, 0, -OH, -IH);
                }
                prism_y(rectangle(-OW, OW, -OH, zc, 1), y2 - 1, 1);
                prism([[-OW, 1], [-OW, y2, 5.5], [OW, y2, 5.5], [OW, 1]], -OH - 1, zc + 1);
            }
            intersection() {
                prism_y([[-w, zc - 1.5], [w, zc - 1.5], [w, top, r], [-w, top, r]], back, y1);
                prism([[-w, y1], [-w, back, r], [w, back, r], [w, y1]], zc - 2, top + 1);
                prism_x([[back, zc - 2], [y1, zc - 2], [y1, top], [back, top, r]], -w - 1, w + 1);
            }
            prism_x([[back + 0.3, zc - 0.3], [back + 0.3, zc + f], [back, zc + f], [back, zc, 0.9 * f],
                     [back - f, zc], [back - f, zc - 0.3]], -w + r, w - r);
        }
        prism_y(connector(step, cz), y2 - 1, y1 + 1);
        box(-5.1, 5.1, y1 - depth, y1 + 1, mz - 2.6, mz + 2.6);
    }
}

module camera_connector_left() {
    off = -1; foot = 4.3; reach = 19.55; up = 6.25; zc = 8.173; hole = 1; back = reach - 3.5; rear = reach - 1.5;
    inner = off - 2; outer = off + 2; bx = 3; z0 = zc - 3.673; z1 = zc + 0.327; yb = 13.55;
    difference() {
        union() {
            cylinder(r = 2, h = foot);
            box(-2, 2, 0, 4, 0, foot);
            hull() {
                box(-2, 2, 3.99, 4, 0, foot);
                box(inner, bx, yb, yb + 0.01, z0, z1);
            }
            prism([[inner, yb - 0.01], [bx, yb - 0.01], [bx, rear, 1.5], [inner, rear]], z0, z1);
            intersection() {
                prism_y([[inner, zc - up], [outer, zc - up], [outer, z0, 1], [bx, z0], [bx, z1], [outer, z1, 1],
                         [outer, zc + up], [inner, zc + up]], back, rear);
                prism([[inner - 1, yb - 1], [bx, yb - 1], [bx, rear, 1.5], [inner - 1, rear]],
                      zc - up - 1, zc + up + 1);
            }
            for (s = [1, -1]) rod([off, back, zc + s * up], [off, reach, zc + s * up], hole + 1.2);
        }
        bore([0, 0, -1], [0, 0, foot + 1], hole);
        box(inner - 5, inner, back - 1, reach + 1, zc - up - 9, zc + up + 9);
        for (s = [1, -1]) bore([off, back - 1, zc + s * up], [off, reach + 1, zc + s * up], hole);
    }
}

if (part == "top_corner") top_corner();
if (part == "bottom_corner") bottom_corner();
if (part == "knee") knee();
if (part == "fork") fork();
if (part == "motor_mount") motor_mount();
if (part == "hub_joint") hub_joint();
if (part == "hub") hub();
if (part == "pi_carrier") pi_carrier();
if (part == "battery_bracket") battery_bracket();
if (part == "battery_sleeve") battery_sleeve();
if (part == "battery_lid") battery_lid();
if (part == "camera_connector_left") camera_connector_left();
if (part == "camera_connector_right") mirror([1, 0, 0]) camera_connector_left();
