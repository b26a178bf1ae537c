/* ground.js -- the ground below the layers, of which only their soft shadow is seen. */
import * as THREE from "three/build/three.module.js";

export class Ground {
	constructor({ renderer, scene }) {
		this.light = new THREE.DirectionalLight(0xffffff, 0); /* no light, but a shadow */
		this.plane = new THREE.Mesh(new THREE.PlaneBufferGeometry(1, 1),
			new THREE.ShadowMaterial({ opacity: 0.3 }));
		this.group = new THREE.Group().add(this.light, this.light.target, this.plane);
		this.plane.receiveShadow = this.light.castShadow = true;
		this.light.shadow.mapSize.set(1024, 1024);
		this.light.shadow.radius = 6;
		renderer.shadowMap.enabled = true;
		renderer.shadowMap.type = THREE.VSMShadowMap;
		scene.add(this.group);
	}

	/* Lies below a box; up, light: where these are. */
	lie({ low, high }, up, light) {
		const middle = new THREE.Vector3(...low).add(new THREE.Vector3(...high)).multiplyScalar(0.5),
			half = new THREE.Vector3(...high).sub(middle), radius = half.length(),
			{ camera } = this.light.shadow;

		this.light.target.position.copy(middle);
		this.light.position.copy(middle).add(light.setLength(4 * radius));
		Object.assign(camera, { left: -3 * radius, right: 3 * radius, top: 3 * radius, bottom: -3 * radius,
			near: radius, far: 6 * radius });
		camera.updateProjectionMatrix();
		this.plane.position.copy(middle).addScaledVector(up, -half.dot(up));
		this.plane.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), up);
		this.plane.scale.setScalar(4.2 * radius); /* all of it in that square */
	}
}
