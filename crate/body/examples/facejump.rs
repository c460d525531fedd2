use raconteur_base::noise;
use raconteur_body::face::*;
use raconteur_body::generator::{build, people::preset};
fn main() {
    for who in ["sofia", "papous", "nuno"] {
        let t = build(&preset(who).unwrap()).figure.tissue.unwrap();
        let mut net = Network::new(&t);
        let rest = FaceControls::default();
        net.reset(&t, &rest, &rest);
        let mut worst = 0f32;
        let mut d = Depths::default();
        let mut fast = 0f32;
        let mut settle = 0usize;
        let mut at = 0;
        for i in 0..10000i64 {
            let mut c = FaceControls::default();
            let u = |k: u64| noise::unit(7, k, i);
            for (k, x) in c.contraction.iter_mut().enumerate() {
                if u(500 + k as u64) < 0.3 {
                    *x = u(k as u64);
                }
            }
            c.protrusion = [u(100) * 2. - 1., u(101) * 2. - 1.];
            if u(102) < 0.3 {
                c.seal = u(103);
            }
            if u(104) < 0.2 {
                c.bite = u(105);
            }
            if u(106) < 0.6 {
                c.jaw.pitch_rad = 0.35 * u(107);
                c.jaw.yaw_rad = 0.1 * (u(108) * 2. - 1.);
                c.jaw.forward_m = 0.006 * u(109);
            }
            for _ in 0..(1 + (u(110) * 4.0) as usize) {
                net.step(&t, &c);
            }
            let s = net.most_stretched();
            if !(s <= worst) {
                worst = s;
                at = i;
            }
            fast = fast.max(net.fastest_m_per_s());
            let e = net.depths();
            d.lips_m = d.lips_m.max(e.lips_m);
            d.teeth_m = d.teeth_m.max(e.teeth_m);
            d.bone_m = d.bone_m.max(e.bone_m);
            if i % 200 == 0 {
                let mut n2 = net.clone();
                let mut last = 0;
                for k in 0..120 {
                    n2.step(&t, &rest);
                    if n2.fastest_m_per_s() > 0.0005 {
                        last = k;
                    }
                }
                settle = settle.max(last);
                let far = (0..t.rest.len())
                    .map(|i| {
                        let p = n2.place(i);
                        (0..3)
                            .map(|k| (p[k] - t.rest[i][k]).powi(2))
                            .sum::<f32>()
                            .sqrt()
                    })
                    .fold(0f32, f32::max);
                if far > 1e-4 {
                    eprintln!("rest off {far}");
                }
            }
        }
        let t0 = std::time::Instant::now();
        let mut c = FaceControls::default();
        c.jaw.pitch_rad = 0.1;
        c.contraction[20] = 0.5;
        for i in 0..2000 {
            c.contraction[21] = f64::from(i % 100) / 100.0;
            net.step(&t, &c);
        }
        eprintln!(
            "{who}: worst stretch {worst} at {at} fastest {fast} settle {settle} depths {d:?} step {:?}",
            t0.elapsed() / 2000
        );
    }
}
