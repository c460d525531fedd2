//! Three outfits.

use raconteur_base::{DVec3, Side};

use super::band::{Band, BandPath};
use super::collar::hood;
use super::cut::{Top, TopCut};
use super::dressed::{Dressed, Neckline, cloth, collar_part, leather, trim};
use super::fade;
use super::finish::{Fabric, plain_part, share_materials};
use super::sheet::Sheet;
use super::shirt::shirt;
use super::shoe::{ShoeCut, ShoeStyle, shoes};
use super::strip::{LayingSurface, Strip, SurfacePoint, button, cord, soften, strip};
use super::top::{open_front, top, up_the_neck};
use super::trousers::{LegEnd, TrouserCut, trousers};
use super::wardrobe::{Cardigan, Hoodie, Outfit, Sweater};
use super::wearer::Wearer;
use crate::part::MeshPart;
use crate::torso::cage::Tag;
use crate::torso::{CM, Cage, Regions, Shell};
use raconteur_body::figure::MaterialKind;
use raconteur_body::skeleton::Bone;

/// Builds the clothes of an outfit on a body.
#[must_use]
pub fn dress(wearer: &Wearer<'_>, outfit: &Outfit) -> Dressed {
    let mut made = match outfit {
        Outfit::Sweater(c) => sweater(wearer, c),
        Outfit::Cardigan(c) => cardigan(wearer, c),
        Outfit::Hoodie(c) => hoodie(wearer, c),
    };
    share_materials(&mut made.parts);
    made
}

/// Adds parts made together with their shells.
fn add(made: &mut Dressed, pieces: impl IntoIterator<Item = (MeshPart, Shell)>) {
    for (part, shell) in pieces {
        made.parts.push(part);
        made.surface.append(shell);
    }
}

/// Ankles between shoe and trousers.
fn socks(wearer: &Wearer<'_>, dye: [f64; 3]) -> MeshPart {
    let first = Cage::leg_ring_at(1.76);
    let shell = wearer
        .cage
        .extract(|t| matches!(t, Tag::Leg(j) if j >= first));
    plain_part("socks", &shell, wearer.field, cloth(MaterialKind::Rib, dye))
}

/// Starts an outfit with the common items: trousers, socks, shoes.
fn below(
    wearer: &Wearer<'_>,
    cut: &TrouserCut,
    shoe: &ShoeCut,
    sock: [f64; 3],
) -> (Dressed, Shell) {
    let (mut parts, shell) = trousers(wearer, cut);
    parts.push(socks(wearer, sock));
    parts.extend(shoes(wearer, shoe));
    let surface = shell.clone();
    (Dressed { parts, surface }, shell)
}

fn sweater(wearer: &Wearer<'_>, c: &Sweater) -> Dressed {
    let unit = CM * wearer.scale;
    let (mut made, trousers) = below(
        wearer,
        &TrouserCut {
            fabric: cloth(MaterialKind::Woven, c.legs.trousers),
            ease_cm: [0.75, 1.5],
            slack: 0.022,
            gather: 1.1,
            end: LegEnd::Plain,
            back_pockets: false,
            seed: 2,
        },
        &ShoeCut {
            style: ShoeStyle::Leather,
            upper: leather(c.legs.shoe),
            sole: leather(c.legs.sole),
            lace: leather(c.legs.sole),
            width: 0.95,
        },
        c.legs.sock,
    );
    let knit = cloth(MaterialKind::Cloth, c.knit);
    let cut = TopCut {
        name: "sweater",
        fabric: knit,
        reach: [0.553, 0.838],
        straight: 0.45,
        ease_cm: [0.5, 1.0],
        sleeve_ease_cm: 0.95,
        slack: 0.045,
        gather: 1.25,
        over_cm: [0.0, 1.1],
        is_taut: true,
        seed: 1,
    };
    let mut top = top(wearer, &cut, &trousers);
    top.sew(wearer);
    // A soft neck, turned over once.
    let rib = knit.woven(MaterialKind::Rib);
    let stand = Band {
        direction: up_the_neck(),
        width: 2.9 * unit,
        thickness: 0.45 * unit,
        ease: 0.08 * unit,
        round: BandPath::Neck(wearer.neck),
        billow: 0.35 * unit,
        every: 1,
    };
    let (part, shell) = top.band(wearer, &top.neck, &stand, rib);
    add(&mut made, [(collar_part(part), shell)]);
    add(
        &mut made,
        top.rib_bands(
            wearer,
            knit.shaded(0.95),
            [5.0, 5.5],
            [1.3, 0.42],
            &trousers,
        ),
    );
    finish_top(&mut made, wearer, &top, &cut);
    made
}

fn finish_top(made: &mut Dressed, wearer: &Wearer<'_>, top: &Top, cut: &TopCut) {
    made.parts.push(top.to_part(wearer, cut));
    made.surface.append(top.sheet.shell.clone());
}

/// Builds corduroy trousers and leather shoes for the cardigan outfit.
fn cardigan_legs(wearer: &Wearer<'_>, c: &Cardigan) -> (Dressed, Shell) {
    below(
        wearer,
        &TrouserCut {
            fabric: cloth(MaterialKind::Corduroy, c.legs.trousers),
            ease_cm: [1.0, 2.3],
            slack: 0.022,
            gather: 1.3,
            end: LegEnd::Plain,
            back_pockets: false,
            seed: 12,
        },
        &ShoeCut {
            style: ShoeStyle::Leather,
            upper: leather(c.legs.shoe),
            sole: leather(c.legs.sole),
            lace: leather(c.legs.sole),
            width: 1.03,
        },
        c.legs.sock,
    )
}

fn cardigan(wearer: &Wearer<'_>, c: &Cardigan) -> Dressed {
    let unit = CM * wearer.scale;
    let (mut made, trousers) = cardigan_legs(wearer, c);
    let vee = Neckline::for_wearer(wearer);
    shirt(&mut made, wearer, c, &vee);

    let knit = cloth(MaterialKind::Cloth, c.knit);
    let cut = TopCut {
        name: "cardigan",
        fabric: knit,
        reach: [0.553, 0.838],
        straight: 0.6,
        ease_cm: [0.95, 1.5],
        sleeve_ease_cm: 1.1,
        slack: 0.06,
        gather: 1.15,
        over_cm: [0.45, 1.0],
        is_taut: true,
        seed: 11,
    };
    let mut top = top(wearer, &cut, &trousers);
    open_along_vee(&mut top, wearer, &vee);
    top.sew(wearer);
    let band = placket(wearer, &top, &vee);
    let rib = knit.woven(MaterialKind::Rib).shaded(0.94);
    let edge = strip(
        &band,
        &Strip {
            width: 3.0 * unit,
            thickness: 0.34 * unit,
            closed: false,
        },
    );
    made.parts.push(trim(wearer, &edge, rib));
    made.surface.append(edge);
    buttons(&mut made, wearer, &top, &vee, c.button);
    patch_pockets(&mut made, wearer, &top, rib);
    add(
        &mut made,
        top.rib_bands(
            wearer,
            knit.shaded(0.94),
            [5.0, 5.0],
            [1.5, 1.35],
            &trousers,
        ),
    );
    finish_top(&mut made, wearer, &top, &cut);
    made
}

/// Removes the front above the V and the nape, and aligns the edges to the V.
fn open_along_vee(top: &mut Top, wearer: &Wearer<'_>, vee: &Neckline) {
    let unit = CM * wearer.scale;
    let neck_z = -2.5 * unit;
    let reach = wearer.field.neck_radius() + 1.7 * unit;
    open_front(
        top,
        wearer.field,
        |p| {
            let front =
                p.z > 0.5 * unit && p.y > vee.low && p.x.abs() < vee.half_width(p.y) - 0.2 * unit;
            let nape =
                p.y > vee.high + 0.8 * unit && DVec3::new(p.x, 0.0, p.z - neck_z).length() < reach;
            front || nape
        },
        |y| (y > vee.low + 0.8 * unit && y < vee.high).then(|| vee.half_width(y)),
    );
}

/// Adds five buttons on the front edge, from the hem to the V-neckline.
fn buttons(made: &mut Dressed, wearer: &Wearer<'_>, top: &Top, vee: &Neckline, dye: [f64; 3]) {
    let unit = CM * wearer.scale;
    let lay = LayingSurface::new(&top.sheet.shell);
    let hem = top.lowest_of_hem();
    for i in 0..5 {
        let y = hem + (vee.low - hem) * (0.08 + 0.21 * i as f64);
        let mut spot = lay.project_along_z(DVec3::new(0.0, y, 0.3));
        spot.place += spot.normal * 0.3 * unit;
        let disc = button(&spot, 0.95 * unit);
        made.parts
            .push(plain_part("button", &disc, wearer.field, leather(dye)));
    }
}

/// Adds a patch pocket on each side: the welt at its opening and the seam around its bag.
fn patch_pockets(made: &mut Dressed, wearer: &Wearer<'_>, top: &Top, rib: Fabric) {
    let unit = CM * wearer.scale;
    let lay = LayingSurface::new(&top.sheet.shell);
    let hem = top.lowest_of_hem();
    for side in Side::BOTH {
        let v = |x: f64, up: f64| DVec3::new(side.sign() * x * unit, hem + up * unit, 0.3);
        let mouth = lay.path(&[v(5.0, 13.5), v(13.0, 13.5)], 1.0 * unit);
        let welt = strip(
            &mouth,
            &Strip {
                width: 2.3 * unit,
                thickness: 0.26 * unit,
                closed: false,
            },
        );
        made.parts.push(trim(wearer, &welt, rib));
        let bag = lay.path(
            &[v(5.2, 12.6), v(5.4, 3.2), v(12.6, 3.2), v(12.8, 12.6)],
            1.6 * unit,
        );
        let seam = strip(
            &bag,
            &Strip {
                width: 0.5 * unit,
                thickness: 0.1 * unit,
                closed: false,
            },
        );
        made.parts.push(trim(wearer, &seam, rib));
    }
}

/// Returns the path of the cardigan's edge: up the front, along the V-neckline, around the nape and
/// back.
fn placket(wearer: &Wearer<'_>, top: &Top, vee: &Neckline) -> Vec<SurfacePoint> {
    let unit = CM * wearer.scale;
    let shell = &top.sheet.shell;
    let lay = LayingSurface::new(shell);
    let hem = top.lowest_of_hem();
    let mut path: Vec<SurfacePoint> = Vec::new();
    for i in 0..22 {
        let y = hem + (vee.low - hem) * i as f64 / 22.0;
        path.push(lay.project_along_z(DVec3::new(0.0, y, 0.3)));
    }
    const SIDE: usize = 16;
    let front = |i: usize, sign: f64| {
        let y = vee.low + (vee.high - vee.low) * i as f64 / SIDE as f64;
        lay.project_along_z(DVec3::new(sign * vee.half_width(y), y, 0.3))
    };
    path.extend((0..SIDE).map(|i| front(i, 1.0)));
    const NAPE: usize = 22;
    for i in 0..=NAPE {
        let a = (75.0 + 210.0 * i as f64 / NAPE as f64).to_radians();
        let back = (-raconteur_base::ops::cos(a)).max(0.0);
        let p = wearer
            .field
            .neck_point(a, vee.high + (0.6 + 1.4 * back) * unit, 1.7 * unit);
        path.push(lay.project(p));
    }
    path.extend((0..SIDE).rev().map(|i| front(i, -1.0)));
    soften(&mut path, 5);
    path
}

/// Jeans and sneakers.
fn hoodie_legs(wearer: &Wearer<'_>, c: &Hoodie) -> (Dressed, Shell) {
    below(
        wearer,
        &TrouserCut {
            fabric: cloth(MaterialKind::Denim, c.legs.trousers),
            ease_cm: [0.95, 1.9],
            slack: 0.03,
            gather: 1.35,
            end: LegEnd::Rolled,
            back_pockets: true,
            seed: 22,
        },
        &ShoeCut {
            style: ShoeStyle::Sneaker,
            upper: cloth(MaterialKind::Woven, c.legs.shoe),
            sole: leather(c.legs.sole),
            lace: leather(c.lace),
            width: 1.0,
        },
        c.legs.sock,
    )
}

fn hoodie(wearer: &Wearer<'_>, c: &Hoodie) -> Dressed {
    let unit = CM * wearer.scale;
    let (mut made, trousers) = hoodie_legs(wearer, c);
    let fleece = cloth(MaterialKind::Fleece, c.fleece);
    let cut = TopCut {
        name: "hoodie",
        fabric: fleece,
        reach: [0.545, 0.826],
        straight: 0.8,
        ease_cm: [1.0, 1.9],
        sleeve_ease_cm: 1.45,
        slack: 0.10,
        gather: 1.35,
        over_cm: [0.2, 1.0],
        is_taut: false,
        seed: 21,
    };
    let mut top = top(wearer, &cut, &trousers);
    top.sew(wearer);
    let neckband = Band {
        direction: up_the_neck(),
        width: 1.4 * unit,
        thickness: 0.35 * unit,
        ease: 0.8 * unit,
        round: BandPath::Body(wearer.field, Regions::ALL),
        billow: 0.0,
        every: 1,
    };
    add(&mut made, [top.band(wearer, &top.neck, &neckband, fleece)]);
    let bag = hood(wearer, 1.7);
    made.parts.push(trim(wearer, &bag, fleece));
    made.surface.append(bag);
    made.parts.push(collar_part(t_shirt(wearer, c.shirt)));
    pouch_and_cords(&mut made, wearer, &top, c);
    add(
        &mut made,
        top.rib_bands(
            wearer,
            fleece.shaded(0.92),
            [5.0, 4.6],
            [1.5, 0.5],
            &trousers,
        ),
    );
    finish_top(&mut made, wearer, &top, &cut);
    made
}

/// Adds the edges of the front pocket for both hands, and the cords of the hood.
fn pouch_and_cords(made: &mut Dressed, wearer: &Wearer<'_>, top: &Top, c: &Hoodie) {
    let unit = CM * wearer.scale;
    let edge = cloth(MaterialKind::Fleece, c.fleece).shaded(0.93);
    let lay = LayingSurface::new(&top.sheet.shell);
    let hem = top.lowest_of_hem();
    let v = |x: f64, up: f64| DVec3::new(x * unit, hem + up * unit, 0.3);
    let mouth = Strip {
        width: 1.1 * unit,
        thickness: 0.3 * unit,
        closed: false,
    };
    for side in Side::BOTH {
        let s = side.sign();
        let path = lay.path(
            &[
                v(5.0 * s, 18.0),
                v(7.0 * s, 15.0),
                v(11.5 * s, 7.5),
                v(11.8 * s, 0.5),
            ],
            1.4 * unit,
        );
        made.parts.push(trim(wearer, &strip(&path, &mouth), edge));
        // The cords hang from the hood.
        let from = DVec3::new(
            2.3 * s * unit,
            wearer.joints.position_of(Bone::Cervical).y - 2.0 * unit,
            0.3,
        );
        let down = DVec3::new(3.0 * s * unit, from.y - (13.0 + 1.2 * s) * unit, 0.3);
        let path = lay.path(
            &[from, from.lerp(down, 0.6) + DVec3::X * 0.5 * s * unit, down],
            1.2 * unit,
        );
        made.parts.push(plain_part(
            "cord",
            &cord(&path, 0.26 * unit),
            wearer.field,
            cloth(MaterialKind::Woven, c.cord),
        ));
    }
    let path = lay.path(&[v(5.0, 18.0), v(-5.0, 18.0)], 1.4 * unit);
    made.parts.push(trim(wearer, &strip(&path, &mouth), edge));
}

/// Builds the edge of the T-shirt that shows in the hood's opening.
fn t_shirt(wearer: &Wearer<'_>, dye: [f64; 3]) -> MeshPart {
    let unit = CM * wearer.scale;
    let rows = Cage::row_at(0.814)..Cage::row_at(0.842);
    let mut sheet = Sheet::extract(
        wearer.cage,
        |t| matches!(t, Tag::Trunk(r) if rows.contains(&r)),
    );
    let high = wearer.cage.row_height(Cage::row_at(0.84));
    sheet.settle(
        wearer.field,
        Regions::ALL,
        |_| 1.0,
        |p| unit * (0.25 + 0.1 * fade(p.y, high - 2.0 * unit, high)),
    );
    trim(wearer, &sheet.shell, cloth(MaterialKind::Fleece, dye))
}
