//! Pictures of the sky by each model, as the device has it, against the committed truth; and the truth against its reference.

use horizon_light::medium::Medium;
use horizon_light::models::air::Air;
use horizon_light::models::isotropic::Isotropic;
use horizon_light::models::moments::Moments;
use horizon_light::models::scatter::{Multiple, Once, Scene, VIEW_STEPS};
use horizon_light::models::sky_view::SkyView;
use horizon_light::models::transmittance::Transmittance;
use horizon_light::reference::orders::{Orders, Resolution};
use horizon_light::reference::picture::{ALTITUDE, HEIGHT, VIEWS, View, WIDTH, passes_sun, sees_sky};
use horizon_light::spectrum::Star;

const MEDIUM: Medium = Medium::BRUNETON;

fn truth(view: &View) -> Vec<[u8; 3]> {
    let file = format!("{}/../../assets/truth/{}", env!("CARGO_MANIFEST_DIR"), view.file());
    let picture = image::open(&file).unwrap_or_else(|error| panic!("{file}: {error}")).into_rgb8();
    assert_eq!(picture.dimensions(), (WIDTH as u32, HEIGHT as u32));
    picture.pixels().map(|pixel| pixel.0).collect()
}

struct Sky {
    air: Air<f32>,
    transmittance: Transmittance<f32>,
}

impl Sky {
    /// PSNR of a model's picture, drawn from a sky view of this size: of the whole, and of the sky alone.
    fn psnr(&self, view: &View, multiple: &impl Multiple<f32>, size: [usize; 3]) -> [f64; 2] {
        let Self { air, transmittance } = self;
        let scene = Scene { air, transmittance, multiple, sunlit: true };
        let mu_s = view.sun_zenith.to_radians().cos() as f32;
        let table = SkyView::sized(&scene, ALTITUDE as f32, mu_s, VIEW_STEPS, size);
        let picture = view.picture(&MEDIUM, |ray| table.radiance(air, ray.mu as f32, ray.nu as f32).map(f64::from));
        let truth = truth(view);
        [passes_sun, sees_sky].map(|counts| view.psnr(&picture, &truth, |ray| counts(&MEDIUM, ray)))
    }
}

#[test]
fn the_default_model_draws_the_truth() {
    use horizon_light::models::sky_view::{ABOVE, AZIMUTHS, BELOW};
    let air = Air::<f32>::new(&MEDIUM);
    let transmittance = Transmittance::new(&air);
    let (moments, isotropic) = (Moments::new(&air, &transmittance), Isotropic::new(&air, &transmittance));
    let sky = Sky { air, transmittance };
    let size = [AZIMUTHS, ABOVE, BELOW];
    for (view, least) in VIEWS.into_iter().zip([47.0, 40.0]) {
        let full = sky.psnr(&view, &moments, size);
        let (fast, once) = (sky.psnr(&view, &isotropic, size), sky.psnr(&view, &Once, size));
        let coarse = sky.psnr(&view, &moments, [AZIMUTHS / 4, ABOVE / 4, BELOW / 4]);
        let name = format!("sun at {}°", view.sun_zenith);
        println!(
            "{name}: full {full:.1?} dB, fast {fast:.1?}, once {once:.1?}; from a sixteenth of the table {coarse:.1?}"
        );
        assert!(full.iter().all(|psnr| *psnr >= least), "{name}: {full:?} dB");
        // A coarser table, and fewer orders of light, show.
        assert!([coarse, fast, once].iter().all(|[whole, _]| *whole < least), "{name}: {coarse:?}, {fast:?}, {once:?}");
    }
}

/// 500 pixels of each picture, by lot: at most a level off, for the reference is a coarser one here.
#[test]
fn the_truth_is_the_reference_s() {
    let sky = Orders::new(&MEDIUM, Resolution::COARSE, 1e-3);
    let to_rgb = Star::of(&MEDIUM).matrix();
    for view in VIEWS {
        let truth = truth(&view);
        let mut differences = 0;
        for i in (0..500).map(|i| (i * 99_991 + 77) % truth.len()) {
            let again = view.pixel(&to_rgb, sky.radiance(&view.ray(i % WIDTH, i / WIDTH)));
            let most = (0..3).map(|k| again[k].abs_diff(truth[i][k])).max();
            assert!(most <= Some(1), "sun at {}°, pixel {i}: {again:?}, not {:?}", view.sun_zenith, truth[i]);
            differences += usize::from(again != truth[i]);
        }
        println!("sun at {}°: {differences} of 500 pixels are a level off", view.sun_zenith);
        assert!(differences < 50, "{differences}");
    }
}
