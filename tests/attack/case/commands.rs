//! Files and flags of each command.

use super::super::mutate;
use super::{FOREIGN, Maker, read};

impl Maker {
    pub(super) fn stiffness(&mut self) {
        self.maybe(
            2,
            "--contact",
            &["roller", "din26281", "hertz", "slice", "elastic", "roller,hertz", "slice,elastic,roller"],
        );
        if self.once_in(2) {
            self.maybe(2, "--torques", &["1", "3.34,16.8", "50", "1e-6", "90,90", "100,1", "1e6"]);
        } else {
            self.maybe(3, "--max-torque", &["10", "1000", "1e-3"]);
        }
        if self.once_in(8) {
            self.case.args.push("--pressure=slices".into());
        }
        if self.once_in(5) {
            let mut fem = read("tests/reference/fem_multi_arc.csv").into_bytes();
            if let Some(mut rng) = self.strike() {
                fem = mutate::table(&String::from_utf8_lossy(&fem), &mut rng);
            }
            self.file("fem.csv", fem);
            self.flag("--fem", "fem.csv");
            self.maybe(2, "--fem-model", &["2-D", "layer", "nothing", "|"]);
        }
    }

    pub(super) fn simulate(&mut self, scenes: &[String]) {
        let scene = if scenes.is_empty() {
            "high-6".to_owned()
        } else {
            scenes[self.rng.usize(..scenes.len())].clone()
        };
        // A name from a mutated file may begin like a flag.
        self.case.plain_flags &= !scene.starts_with('-');
        self.flag("--scenario", scene);
        if self.once_in(6) {
            self.flag("--method", "published");
            self.maybe(2, "--band", &["1e-3", "1e-6"]);
        } else {
            self.maybe(8, "--tolerance", &["1e-4", "1e-8", "1e-3"]);
        }
        self.maybe(8, "--step", &["1e-5", "1e-6", "1e-4"]);
        self.switch(6, "--full");
    }

    pub(super) fn optimize(&mut self) {
        let evaluations = self.one(&["1", "2", "5"]);
        self.flag("--evaluations", evaluations);
        let starts = self.one(&["1", "1", "2"]);
        self.flag("--starts", starts);
        self.maybe(20, "--global", &["80"]);
        if self.once_in(8) {
            self.flag("--pareto", "slip-margin,torque-capacity");
            self.flag("--points", "2");
        }
        if self.once_in(8) {
            self.case.args.push("--robust".into());
            self.flag("--draws", "10");
        }
        self.switch(10, "--full");
        self.maybe(10, "--tolerance", &["1e-4", "1e-5"]);
        self.output("-o", "new.toml");
        match self.rng.u8(..10) {
            // A journal that an earlier search left, perhaps spoilt since.
            0..3 => {
                self.flag("--journal", "j.csv");
                self.case.prepare = [
                    "optimize",
                    "design.toml",
                    "--evaluations",
                    "1",
                    "--starts",
                    "1",
                    "-q",
                    "-o",
                    "new.toml",
                ]
                .iter()
                .chain(&["--journal", "j.csv"])
                .map(|arg| (*arg).to_owned())
                .collect();
                if self.once_in(3) {
                    self.case.args.push("--resume".into());
                }
                if let Some(rng) = self.strike() {
                    self.case.spoil.push(("j.csv", rng));
                }
                self.case.outputs.push("j.csv".into());
            }
            3 => {
                self.flag("--journal", FOREIGN.0);
                self.case.plain_flags = false;
            }
            4 => {
                self.case.args.push("--resume".into());
                self.case.plain_flags = false;
            }
            _ => {}
        }
    }

    pub(super) fn identify(&mut self) {
        let mut data = self.one(&[
            "torque_nm,windup_deg\n10,1.2345\n16.8,1.94\n50,5.1\n",
            "label,use,torque_nm,windup_deg,windup_deg_sigma\na,,10,1.2345,0.01\nb,fit,16.8,1.94,0.02\nd,check,90,8.5,0.1\n",
            "torque_nm,normal_inner_n,hertz_inner_mpa,k_secant_nm_per_rad\n3.34,319.1,805,431\n10,940,1380,466\n60,5000,,\n",
            "lift_off_rpm,nominal_torque_nm,end_torque_nm,races.inner_radius_mm\n4970,,,11.11\n,100,,11.11\n,,150,11.12\n",
        ]);
        for _ in 0..self.rng.u8(..3) {
            if let Some(mut rng) = self.strike() {
                data = String::from_utf8_lossy(&mutate::table(&data, &mut rng)).into_owned();
            }
        }
        self.file("data.csv", data.into_bytes());
        self.flag("--data", "data.csv");
        let unknown = self.one(&[
            "r_i1_mm:3.6:4.8",
            "friction.static:0.05:0.2",
            "material.youngs_modulus_gpa:100:300,r_i1_mm:3.9:4.2",
            "sprags.centre_distance_mm:0.5:0.8",
            "centroid_y_mm:0.3:0.8",
            "races.inner_radius_mm:11:11.2",
            "contact.slices:10:60",
        ]);
        self.case.plain_flags = false; // what an unknown may be depends on the design
        self.flag("--unknown", unknown);
        self.flag("--starts", "1");
        self.flag("--evaluations", "8");
        self.maybe(4, "--seed", &["0", "7"]);
        if self.once_in(2) {
            self.output("-o", "new.toml");
        }
    }

    pub(super) fn size(&mut self) {
        self.case.plain_flags = false; // no file is read
        let (bore, torque) =
            (self.one(&["40", "10", "1", "2000", "25.5"]), self.one(&["1000", "50", "1e-3", "1e6", "300"]));
        self.flag("--bore", bore);
        self.flag("--torque", torque);
        self.maybe(2, "--speed", &["0", "3000", "1e6"]);
        self.maybe(3, "--safety", &["1", "1.3", "10"]);
        self.maybe(3, "--friction", &["0.05", "0.2", "1.5"]);
        self.output("-o", "new.toml");
    }

    pub(super) fn export(&mut self) {
        self.case.args.extend(["--format".to_owned(), "calculix".to_owned()]);
        if self.once_in(3) {
            let mut result = read("tests/reference/calculix_excerpt.dat").into_bytes();
            if let Some(mut rng) = self.strike() {
                result = mutate::table(&String::from_utf8_lossy(&result), &mut rng);
            }
            self.file("x.dat", result);
            self.flag("--read", "x.dat");
            self.maybe(3, "--torques", &["3.34", "1,2"]);
            return;
        }
        let mesh = self.one(&["0.2", "0.1", "0.5"]);
        self.flag("--mesh", mesh);
        self.maybe(2, "--variant", &["plane-strain", "plane-stress", "layer"]);
        self.maybe(2, "--torque", &["10", "26.8", "1e5"]);
        self.maybe(4, "--increments", &["1", "12"]);
        self.maybe(4, "--friction", &["0.3", "0.05"]);
        if self.once_in(2) {
            self.output("-o", "deck.inp");
        }
    }

    pub(super) fn evaluate(&mut self) {
        self.switch(4, "--describe");
        self.switch(4, "--full");
        let mut lines = String::new();
        for _ in 0..self.rng.u8(1..4) {
            lines += &self.one(&[
                "[3.6, 4.2, -0.2, 0.2]\n",
                "[4.08, 4.15, 0.19, 0.52]\n",
                "[4.3, 4.4, 0.08, 5.0, 1.096]\n",
                "[4.1,4.2]\n",
                "\n",
                "[]\n",
                "[1]",
            ]);
        }
        for _ in 0..self.rng.u8(..3) {
            if let Some(mut rng) = self.strike() {
                lines = String::from_utf8_lossy(&mutate::table(&lines, &mut rng)).into_owned();
            }
        }
        self.case.plain_flags = false; // the lines are refused one by one
        self.case.input = lines.into_bytes();
    }
}
